// `#for` runs up and down and in parts; a step of the wrong sign runs not at all.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#for (I, 0, 4) sphere { <I*0.8 - 1.6, -0.6, 0>, 0.3 pigment { rgb <0.9, I/4, 0.2> } } #end
#for (I, 2, -2, -0.5) sphere { <I, 0.1, 0.5>, 0.2 pigment { rgb <0.2, 0.7, 0.3> } } #end
#for (I, 0, 1, 0.1) sphere { <I*3 - 1.5, 0.6, 1>, 0.12 pigment { rgb <0.2, I, 0.9> } } #end
#for (I, 1, 0) sphere { 0, 2 pigment { rgb <1, 0, 0> } } #end
