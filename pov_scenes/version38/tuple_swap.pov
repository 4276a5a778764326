// All values of a tuple are read before a name is declared.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare P = 0.4;
#declare Q = 1;
#declare (P, Q) = (Q, P);
sphere { -1.5*x, P }
sphere { 1.5*x, Q pigment { rgb <1, 0.5, 0.2> } }
