// `fresnel 0.5` in a finish scales its specular light by Fresnel's law with the ior of the interior.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { -1.5*x, 1.2 pigment { rgb <1, 0.6, 0.3> } finish { diffuse 0 specular 1 roughness 0.1 fresnel 0.5 } interior { ior 1.5 } }
sphere { 1.5*x, 1.2 pigment { rgb <1, 0.6, 0.3> } finish { diffuse 0 specular 1 roughness 0.1 fresnel 0.5 } interior { ior 2.2 } }
