// The colour of a metallic `specular` highlight follows the angle between the light and the half vector, that of `phong` the normal's.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#default { pigment { rgb <1, 0.6, 0.2> } }
sphere { -1.5*x, 1.2 finish { diffuse 0 specular 0.8 roughness 0.1 metallic } }
sphere { 1.5*x, 1.2 finish { diffuse 0.2 phong 0.4 phong_size 4 specular 0.5 roughness 0.05 metallic 0.6 } }
plane { y, -1.2 finish { diffuse 0.1 specular 0.7 roughness 0.2 metallic } }
