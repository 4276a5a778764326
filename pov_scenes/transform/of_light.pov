// A light and a camera are moved by their transforms too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 38 rotate <15, 20, 0> }
light_source { <0, 0, -8>, rgb 1 rotate <45, 0, 0> translate <-1, 0, 0> scale <1, 1.2, 1> }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb <0.7, 0.7, 0.9> } }
