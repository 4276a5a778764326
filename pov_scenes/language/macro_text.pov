// A macro's body is text in its place: 2*Sum() with the body `a + b` is 2*a + b.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Sum() 0.1 + 0.5 #end
#macro Centre() <-1, 0, 0>, #end
sphere { Centre() 2*Sum() pigment { rgb <0.9, 0.6, 0.2> } }
sphere { <1, 0, 0>, (Sum()) pigment { rgb <0.2, 0.6, 0.9> } }
