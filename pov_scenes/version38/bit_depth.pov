// Levels of fewer and of more than 8 bits.
// switches: +FN1
// switches: +FN4
// switches: +FN5 +UA
// switches: +FN12
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z right 4*x up 3*y }
plane { z, 0 pigment { gradient x color_map { [0 rgb <1, 0.3, 0>] [1 rgb <0, 0.5, 1>] } scale 4.1 translate -2.05*x } finish { emission 1 diffuse 0 } }
