// Without an ior `fresnel` in a finish leaves diffuse light alone and takes all highlights.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { -1.5*x, 1.2 pigment { rgb <1, 0.6, 0.3> } finish { diffuse 0.8 specular 0.5 fresnel on } }
sphere { 1.5*x, 1.2 pigment { rgb <1, 0.6, 0.3> } finish { diffuse 0.8 specular 0.5 fresnel off } }
