// Specks of a tenth of a pixel, far apart, before a plain wall.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -10> look_at 0 angle 30 }
light_source { <-4, 6, -20>, rgb 0.8 }
plane { z, 1 pigment { rgb 0.3 } }
#declare R = seed(3);
#for (I, 1, 60)
  sphere { <5*rand(R) - 2.5, 3.6*rand(R) - 1.8, 0>, 0.008 pigment { rgb <0.8, 0.8, 0.5> } finish { ambient 0.6 diffuse 0.3 } }
#end
