// The pattern potential of a blob.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare B = blob { threshold 0.3 sphere { 0, 2, 1 } cylinder { <-2, 0, 0>, <2, 0, 0>, 0.8, -0.5 } sphere { <1, 1, 0>, 1, 0.7 } }
plane { z, 0 pigment { potential { B } color_map { [0 rgb 1] [0.5 rgb <1, 0.6, 0.1>] [1 rgb <0.6, 0, 0.2>] } } }
