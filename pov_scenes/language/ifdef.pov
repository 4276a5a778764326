// `#ifdef` and `#ifndef` ask for names.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Here = 1;
#ifdef (Here) sphere { <-1, 0, 0>, 0.7 pigment { rgb <0.4, 0.9, 0.4> } } #else sphere { 0, 2 } #end
#ifndef (Absent) sphere { <1, 0, 0>, 0.7 pigment { rgb <0.4, 0.4, 0.9> } } #else sphere { 0, 2 } #end
#ifndef (Size) #declare Size = 0.3; #end
sphere { <0, 0.9, 0>, Size pigment { rgb 0.9 } }
