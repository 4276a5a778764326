// After the loop the counter is the first value beyond the end.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#for (K, 1, 5, 2) #end
sphere { <0, 0, 0>, K/10 pigment { rgb <K/7, 0.5, 0.2> } }
