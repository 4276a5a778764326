// Signs bind tighter than `*`; `!` gives 0 or 1; a minus after an operator is allowed.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.2, -0.2 + 2*-0.1, 0>, - -0.5 pigment { rgb <0.9, 0.4, 0.4> } }
sphere { -<0, 0.2, 0>, 0.4*!0 pigment { rgb <0.4, 0.9, 0.4> } }
sphere { <1.2, 0, 0> + -y*0.2, 0.3 + !3 + !!2*0.2 pigment { rgb <0.4, 0.4, 0.9> } }
