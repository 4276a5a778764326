// Before 3.5 a number needs no `;`, also where it ends a macro that gives it to a parameter.
#version 3.1;
#macro Twice(Of, Into) #declare Into = 2*Of #end
#declare Size = 0
Twice(0.4, Size)
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, Size pigment { color rgb <0.9, 0.6, 0.3> } }
