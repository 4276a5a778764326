// Transforms behind `looks_like` move the object with the light.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -9> look_at <0, 0.5, 0> angle 50 }
plane { y, 0 pigment { rgb <0.8, 0.7, 0.6> } }
sphere { <-1.5, 1, 0>, 1 pigment { rgb <0.9, 0.4, 0.3> } finish { phong 0.5 } }
box { <0.6, 0, -0.6>, <2, 1.6, 0.8> pigment { rgb <0.3, 0.6, 0.9> } finish { specular 0.4 } }
#declare Lamp = light_source { <0, 2, 0>, rgb 0.6 looks_like { box { -0.3, 0.3 pigment { rgb <1, 1, 0.5> } finish { ambient 1 } rotate 30*z } } rotate 20*x };
light_source { Lamp translate <-3, 0.5, 0> }
object { Lamp translate <2.6, 1, -1> scale 1.2 }
