// Components of bracketed expressions and of function results.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare A = <0.2, 0.4, 0.6>;
sphere { <(A*3).x - 1.6, (A + 0.1).y, 0>, vrotate(A, 90*z).y + 0.3 pigment { rgb <0.9, 0.7, 0.3> } }
sphere { <1, 0, 0>, (A.x + A.y) pigment { rgb vnormalize(A) } }
