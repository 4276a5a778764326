// A declared light can be moved and used several times.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -9> look_at <0, 0.5, 0> angle 50 }
plane { y, 0 pigment { rgb <0.8, 0.7, 0.6> } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.4, 0.3> } finish { phong 0.5 } }
box { <0.6, 0, -0.6>, <2, 1.6, 0.8> pigment { rgb <0.3, 0.6, 0.9> } finish { specular 0.4 } }
#declare Spot = light_source { <0, 6, 0>, rgb 0.8 spotlight point_at 0 radius 8 falloff 16 };
light_source { Spot }
light_source { Spot translate <2.5, 0, -1> }
object { Spot rotate 20*z translate <-2.5, 0, 0> }
union { object { Spot } box { <-4, 0, 1>, <-3, 1, 2> pigment { rgb 1 } } translate <0, 1, -2> }
