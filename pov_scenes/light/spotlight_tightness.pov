// `tightness` makes the middle of a spotlight brighter.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -9> look_at <0, 0.5, 0> angle 50 }
plane { y, 0 pigment { rgb <0.8, 0.7, 0.6> } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.4, 0.3> } finish { phong 0.5 } }
box { <0.6, 0, -0.6>, <2, 1.6, 0.8> pigment { rgb <0.3, 0.6, 0.9> } finish { specular 0.4 } }
light_source { <3, 6, -4>, rgb 1.2 spotlight point_at <0, 0, 0> radius 10 falloff 45 tightness 20 }
