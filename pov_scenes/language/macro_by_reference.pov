// An argument that is a bare name is passed by reference: the macro changes the caller's value.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#macro Grow(A) #declare A = A*2; #end
#declare Size = 0.35;
#declare Same = 0.35;
Grow(Size)
Grow((Same))
sphere { <-1, 0, 0>, Size pigment { rgb <0.9, 0.4, 0.6> } }
sphere { <1, 0, 0>, Same pigment { rgb <0.4, 0.6, 0.9> } }
