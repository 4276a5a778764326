// Internal functions by their names in functions.inc, as pigments.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#include "functions.inc"
plane { -z, -1 pigment { function { f_ridged_mf(x, y, z, 0.8, 2, 5, 0.9, 2, 2) } color_map { [0 rgb <0.1, 0.2, 0.1>] [1 rgb <1, 0.9, 0.8>] } } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { function { f_helix1(x, y, z, 2, 6, 0.1, 0.5, 1, 1, 0) + 0.3 } color_map { [0 rgb <1, 0.9, 0.6>] [1 rgb <0.1, 0.1, 0.4>] } } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { function { f_hex_x(5*x, 5*y, z, 1) * f_noise3d(4*x, 4*y, 4*z) } } }
