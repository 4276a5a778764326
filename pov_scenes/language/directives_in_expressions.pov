// Directives may stand between any two tokens, also inside vectors and before operators.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1, #declare R = 0.6; 0, 0>, R pigment { rgb <0.9, #if (R > 0.5) 0.7 #else 0.1 #end , 0.3> } }
sphere { <1, 0, 0>, 0.2 #if (R = 0.6) + 0.4 #end pigment { rgb <0.3, 0.5, 0.9> } }
