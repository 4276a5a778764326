// The shadows of a lemon and of an open one.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { y, -1 pigment { rgb <0.6, 0.7, 0.8> } }
lemon { <-1.5, -1, 0>, 0.6, <-1, 0.8, 0>, 0, 2 pigment { rgb <0.9, 0.8, 0.2> } }
lemon { <1.2, -0.9, 0>, 0.5, <1.6, 0.9, 0.5>, 0.3, 3 open pigment { rgbf <0.9, 0.4, 0.2, 0.6> } }
