// select with three and four values, bitwise functions, defined.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Known = 1;
#for (I, -1, 1)
  sphere { <I*1.4, select(I, -0.4, 0, 0.4), 0>, select(I, 0.3, 0.6) pigment { rgb <bitwise_and(6, 3), bitwise_or(1, 2) - 2.5, bitwise_xor(5, 4)/2> } }
#end
sphere { <0, 1, 1>, 0.2 + defined(Known)*0.2 + defined(Unknown) pigment { rgb <0.9, 0.9, 0.3> } }
