// Comparisons give 1 or 0, chain from left to right and tolerate tiny differences.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare A = (3 > 2 > 1);
#declare B = (1 < 2 <= 2);
#declare C = (0.1 + 0.2 = 0.3);
#declare D = (1 != 1 + 1e-12);
sphere { <-1.8, 0, 0>, 0.2 + A*0.3 pigment { rgb <0.9, 0.4, 0.4> } }
sphere { <-0.6, 0, 0>, 0.2 + B*0.3 pigment { rgb <0.4, 0.9, 0.4> } }
sphere { <0.6, 0, 0>, 0.2 + C*0.3 pigment { rgb <0.4, 0.4, 0.9> } }
sphere { <1.8, 0, 0>, 0.2 + D*0.3 pigment { rgb <0.9, 0.9, 0.4> } }
