// A lamp's colour may be a colour, a vector or a number; the comma before it is optional.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 4, -4> color rgb <0.5, 0, 0> }
light_source { <0, 6, -6>, <0, 0.4, 0> }
light_source { <5, 3, -3> 0.4 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb 0.9 } }
