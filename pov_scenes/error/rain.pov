// Two thousand little balls over a matt floor.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.8, -7> look_at <0, 0.6, 0> angle 42 }
light_source { <-5, 8, -6>, rgb 0.85 }
background { rgb <0.5, 0.6, 0.75> }
plane { y, -0.8 pigment { rgb <0.6, 0.55, 0.5> } finish { ambient 0.1 diffuse 0.7 } }
#declare S = seed(11);
#for (I, 1, 2000)
  sphere { <6*rand(S) - 3, 3*rand(S) - 0.7, 5*rand(S) - 2>, 0.03 + 0.03*rand(S)
    pigment { rgb <0.3 + 0.6*rand(S), 0.3 + 0.5*rand(S), 0.3 + 0.4*rand(S)> } finish { ambient 0.08 diffuse 0.7 phong 0.3 } }
#end
