// Multiplication binds tighter than addition; both go from left to right.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare R = 1 + 2*3 - 8/2/2 - 4.5;
sphere { <-1, 0, 0>, R pigment { rgb <1 - 0.5*0.4, 0.2 + 0.8/4, (0.2 + 0.8)/4> } }
box { <0.6, 1 - 1.2 - 0.4, -0.5>, <0.6, 0, -0.5> + <1, 2, 3>*0.4 pigment { rgb 2*<0.1, 0.2, 0.4> } }
