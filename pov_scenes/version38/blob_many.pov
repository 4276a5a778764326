// A blob of more than 256 components.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
blob { threshold 0.5 #for (I, 1, 300) sphere { <2.2*sin(I), 1.2*cos(1.7*I), sin(2.3*I)>, 0.5, 1 } #end pigment { rgb <0.7, 0.5, 0.9> } finish { specular 0.3 } }
