// `#local` at the top level acts like `#declare`; `#undef` forgets a name.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#local A = 0.5;
#declare B = 0.7;
#undef A
#ifdef (A) #declare B = 0.1; #end
sphere { 0, B pigment { rgb <0.5, 0.5, 0.9> } }
