// A lamp of negative colour takes light away.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
light_source { <2, 4, -1>, rgb <-0.6, -0.3, 0> }
sphere { <-0.5, 0, 0>, 0.8 pigment { rgb 0.9 } }
