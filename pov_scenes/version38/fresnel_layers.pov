// Each layer of a texture has a `fresnel` of its own.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1.6 texture { pigment { rgb <1, 0.6, 0.3> } finish { diffuse 0.8 fresnel 1 } } texture { pigment { rgbt <0.2, 0.5, 1, 0.5> } finish { specular 0.8 fresnel 0.5 } } interior { ior 1.6 } }
