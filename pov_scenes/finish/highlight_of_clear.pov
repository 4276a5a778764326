// The highlight of a transparent surface is as bright as that of an opaque one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.1, 0, 0>, 0.9 pigment { rgbt <0.6, 0.2, 0.2, 0> } finish { specular 0.9 roughness 0.02 } }
sphere { <1.1, 0, 0>, 0.9 pigment { rgbt <0.6, 0.2, 0.2, 0.8> } finish { specular 0.9 roughness 0.02 } }
