// The pattern potential as a normal and in a texture_map.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare B = blob { threshold 0.4 sphere { <0.5, 0, 0>, 1.5, 1 } sphere { <-0.7, 0.4, 0>, 1.2, 1 } }
sphere { -1.4*x, 1.2 pigment { rgb <0.9, 0.7, 0.5> } normal { potential { B } 0.8 scale 0.6 } finish { specular 0.5 } }
sphere { 1.4*x, 1.2 texture { potential { B } texture_map { [0.2 pigment { rgb 1 }] [0.6 pigment { rgb <0.2, 0.3, 0.8> } finish { phong 0.8 }] } translate 1.4*x } }
