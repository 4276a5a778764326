// A plane cuts a sphere; the inverse plane keeps the other half.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
intersection { sphere { 0, 0.9 } plane { <0.3, 1, -0.4>, 0 } translate -1.1*x pigment { rgb <0.9, 0.4, 0.3> } }
intersection { sphere { 0, 0.9 } plane { <0.3, 1, -0.4>, 0 inverse } translate 1.1*x pigment { rgb <0.3, 0.4, 0.9> } }
