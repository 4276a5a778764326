// A box without thickness is visible and casts a shadow.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-1.2, -0.9, 0>, <0.4, 0.9, 0> pigment { rgb <0.9, 0.3, 0.3> } rotate 20*y }
box { <-1, 1.2, -1>, <1.2, 1.2, 0.6> pigment { rgb <0.3, 0.8, 0.3> } }
