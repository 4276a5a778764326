// A macro may stand for a value, a list of values or a part of a vector.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Square(X) (X*X) #end
#macro Point(X) <X, Square(X) - 0.5, 0> #end
#macro Two() 0.3, 0.6 #end
#for (X, -1.2, 1.2, 0.2) sphere { Point(X), 0.1 pigment { rgb <0.9, Two()> } } #end
