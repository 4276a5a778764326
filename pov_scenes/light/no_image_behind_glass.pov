// An object with `no_image` is not seen through glass either.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <0, 0, -1>, 0.8 pigment { rgbt <1, 1, 1, 0.8> } interior { ior 1.2 } }
box { <-1, -0.9, 1>, <1, 0.8, 1.4> pigment { rgb <0.9, 0.3, 0.3> } no_image }
