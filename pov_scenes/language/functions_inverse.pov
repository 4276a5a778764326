// Inverse and hyperbolic functions: asin, acos, atan, sinh, cosh, tanh, asinh, acosh, atanh.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Ball(I, H)
  sphere { <I*0.5 - 2, H*0.4, 0>, 0.22 pigment { rgb <0.3 + I*0.07, 0.9 - I*0.08, 0.5> } }
#end
Ball(0, asin(0.8)) Ball(1, acos(0.8)) Ball(2, atan(2)) Ball(3, sinh(0.7)) Ball(4, cosh(0.7))
Ball(5, tanh(0.7)) Ball(6, asinh(1.5)) Ball(7, acosh(1.5)) Ball(8, atanh(-0.6))
