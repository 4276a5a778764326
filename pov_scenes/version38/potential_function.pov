// The pattern potential in a function.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare F = function { pattern { potential { blob { threshold 0.3 sphere { 0, 2, 1 } sphere { <1, 1, 0>, 1, -0.7 } } } threshold on } }
plane { z, 0 pigment { function { F(x, y, z) * 0.5 + 0.5 } color_map { [0 rgb 1] [0.5 rgb <1, 0.6, 0.1>] [1 rgb <0.6, 0, 0.2>] } } }
