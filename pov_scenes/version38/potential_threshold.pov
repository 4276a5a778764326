// The pattern potential of a moved blob less its threshold.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { z, 0 pigment { potential { blob { threshold 0.3 sphere { 0, 2, 1 } sphere { <1, 1, 0>, 1, 0.7 } scale <1.2, 0.9, 1> rotate 20*z } translate -0.3*x } threshold on color_map { [0 rgb 1] [0.5 rgb <1, 0.6, 0.1>] [1 rgb <0.6, 0, 0.2>] } scale 0.9 } }
