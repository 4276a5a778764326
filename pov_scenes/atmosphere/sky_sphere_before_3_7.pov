// Before 3.7 the pigments of a sky only weaken those below.
#version 3.6;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -9> look_at <0, 1, 0> angle 50 }
light_source { <-8, 12, -9>, rgb 1 }
box { <-40, -1, -4>, <40, 0, 60> pigment { checker rgb 0.9 rgb <0.2, 0.4, 0.3> scale 2 } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.4, 0.3> } finish { reflection 0.3 } }
sphere { <2, 1, 1>, 1 hollow pigment { rgbf <0.9, 0.9, 1, 0.8> } interior { ior 1.3 } }
cylinder { <0, 0, 20>, <0, 6, 20>, 1 pigment { rgb <0.8, 0.8, 0.2> } }
background { rgbft <0.3, 0.5, 0.9, 0.1, 0.3> }
sky_sphere { pigment { checker rgbt <0.9, 0.8, 0.4, 0.3> rgbf <0.4, 0.6, 0.9, 0.5> scale 0.2 } pigment { hexagon rgbt <1, 1, 1, 0.3> rgbf <0.9, 0.7, 0.5, 0.8> rgbft <0.2, 0.3, 0.9, 0.3, 0.6> scale 0.1 } }
