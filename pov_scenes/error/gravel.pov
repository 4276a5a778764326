// Thousands of balls, many smaller than a pixel.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -5> look_at <0, 0, 1> angle 45 }
light_source { <-4, 6, -8>, rgb 0.8 }
background { rgb <0.5, 0.6, 0.7> }
#declare R = seed(7);
#for (I, 1, 3000)
  sphere { <8*rand(R) - 4, 0.2*rand(R), 20*rand(R) - 3>, 0.01 + 0.07*rand(R)*rand(R)
    pigment { rgb <rand(R), 0.3 + 0.4*rand(R), 0.3> } finish { ambient 0.1 diffuse 0.7 } }
#end
plane { y, -0.05 pigment { rgb <0.3, 0.25, 0.2> } }
