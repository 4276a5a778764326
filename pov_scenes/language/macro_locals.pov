// Names of `#local` in a macro are its own; `#declare` in it reaches the file.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare A = 0.3;
#macro Change() #local A = 0.9; #declare B = A; #end
Change()
sphere { <-1, 0, 0>, A pigment { rgb <0.9, 0.7, 0.4> } }
sphere { <1, 0, 0>, B pigment { rgb <0.4, 0.7, 0.9> } }
