// Random streams give the same numbers on every run.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare S1 = seed(42);
#declare S2 = seed(-7);
#for (I, 1, 40)
  sphere { <rand(S1)*4 - 2, rand(S1) - 0.6, rand(S1)*2>, 0.05 + rand(S2)*0.15 pigment { rgb <rand(S2), rand(S2), rand(S2)> } }
#end
