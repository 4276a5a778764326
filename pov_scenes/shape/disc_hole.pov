// A disc with a hole is a ring and casts the shadow of one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
disc { <-0.9, 0.1, 0>, <0.1, 1, -0.5>, 1, 0.5 pigment { rgb <0.9, 0.7, 0.3> } }
disc { <1.2, 0, 0>, <0, 0, -3>, 0.8, 0.7 pigment { rgb <0.3, 0.6, 0.9> } }
