// Before 3.7 a sky is not there in pictures with an alpha channel, but in mirrors.
// switches: +UA
#version 3.6;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -9> look_at <0, 1, 0> angle 50 }
light_source { <-8, 12, -9>, rgb 1 }
box { <-40, -1, -4>, <40, 0, 60> pigment { checker rgb 0.9 rgb <0.2, 0.4, 0.3> scale 2 } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.4, 0.3> } finish { reflection 0.3 } }
sphere { <2, 1, 1>, 1 hollow pigment { rgbf <0.9, 0.9, 1, 0.8> } interior { ior 1.3 } }
cylinder { <0, 0, 20>, <0, 6, 20>, 1 pigment { rgb <0.8, 0.8, 0.2> } }
sky_sphere { pigment { rgb <0.9, 0.8, 0.4> } }
