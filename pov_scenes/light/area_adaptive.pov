// `adaptive` divides an area light only where its corners differ.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -9> look_at <0, 0.5, 0> angle 50 }
plane { y, 0 pigment { rgb <0.8, 0.7, 0.6> } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.4, 0.3> } finish { phong 0.5 } }
box { <0.6, 0, -0.6>, <2, 1.6, 0.8> pigment { rgb <0.3, 0.6, 0.9> } finish { specular 0.4 } }
light_source { <4, 7, -5>, rgb 1 area_light <3, 0, 0>, <0, 2, 2>, 9, 5 adaptive 0 }
