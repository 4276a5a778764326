// A negative right vector mirrors the picture.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> right -1.33*x look_at <0.5, 0, 0> }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
cone { <-1, -1, 0>, 0.8, <-1, 1, 0>, 0 pigment { rgb <0.9, 0.3, 0.3> } }
box { <0.4, -1, -0.4>, <1.4, 0.3, 0.4> pigment { rgb <0.3, 0.3, 0.9> } }
