// `&` and `|` have one rank and go from left to right: 1|0&0 is 0, 0&0|1 is 1.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare A = (1 | 0 & 0);
#declare B = (0 & 0 | 1);
#declare C = (1 | (0 & 0));
sphere { <-1.4, 0, 0>, 0.2 + A*0.4 pigment { rgb <0.9, 0.4, 0.4> } }
sphere { <0, 0, 0>, 0.2 + B*0.4 pigment { rgb <0.4, 0.9, 0.4> } }
sphere { <1.4, 0, 0>, 0.2 + C*0.4 pigment { rgb <0.4, 0.4, 0.9> } }
