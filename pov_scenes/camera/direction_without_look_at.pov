// A direction of its own, oblique to right and up, without look_at.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0.5, -4> direction <0.3, -0.1, 1.2> }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <0.5, 0, 0>, 0.9 pigment { rgb <0.3, 0.5, 0.8> } }
