// Arithmetic on colours works on all five channels.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare A = rgbf <0.8, 0.2, 0.2, 0.6>;
#declare B = rgbt <0.2, 0.2, 0.8, 0.4>;
sphere { <-1.4, 0, 0>, 0.6 pigment { color A*0.5 } }
sphere { <0, 0, 0>, 0.6 pigment { color (A + B)/2 } }
sphere { <1.4, 0, 0>, 0.6 pigment { color A*B + <0.2, 0.5, 0.1, 0, 0> } }
