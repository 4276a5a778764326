// Diffuse light in four strengths; more than one is allowed.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#for (I, 0, 3)
  sphere { <I*1.2 - 1.8, 0, 0>, 0.55 pigment { rgb <0.9, 0.7, 0.5> } finish { ambient 0 diffuse 0.4*I } }
#end
