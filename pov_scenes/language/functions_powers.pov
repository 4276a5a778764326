// exp, ln, log, sqrt, pow as heights; pow of a negative base to a whole power.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Ball(I, H)
  sphere { <I*0.6 - 1.8, H*0.4, 0>, 0.25 pigment { rgb <0.9 - I*0.1, 0.3 + I*0.1, 0.7> } }
#end
Ball(0, exp(0.5)) Ball(1, ln(5)) Ball(2, log(30)) Ball(3, sqrt(2)) Ball(4, pow(1.7, 0.8)) Ball(5, pow(-1.2, 3)) Ball(6, tan(-0.6))
