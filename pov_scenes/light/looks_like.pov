// `looks_like` shows an object in the place of a light; it casts no shadow.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -9> look_at <0, 0.5, 0> angle 50 }
plane { y, 0 pigment { rgb <0.8, 0.7, 0.6> } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.4, 0.3> } finish { phong 0.5 } }
box { <0.6, 0, -0.6>, <2, 1.6, 0.8> pigment { rgb <0.3, 0.6, 0.9> } finish { specular 0.4 } }
light_source { <0, 2.5, 0>, rgb 1 looks_like { sphere { 0, 0.5 pigment { rgb <1, 1, 0.5> } finish { ambient 1 } } scale <1, 0.6, 1> } }
light_source { <0, 9, -3>, rgb 0.3 }
