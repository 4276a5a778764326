// A plane of water holds all below it, with the camera in it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, -0.6, -4> look_at <0, 0.3, 0> angle 60 }
light_source { <-2, 6, -6>, rgb 1 }
plane { y, 0.02 pigment { rgbf <0.8, 0.95, 1, 0.9> } interior { ior 1.33 } }
box { <-1, -2, 0>, <0.2, 1.5, 1> pigment { checker rgb 0.9, rgb <0.8, 0.3, 0.2> scale 0.31 } }
plane { y, -2 pigment { rgb <0.8, 0.7, 0.5> } }
