// Fresnel highlights with metallic colours and brilliance.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { -1.4*x, 1.2 pigment { rgb <0.9, 0.6, 0.2> } finish { fresnel 1 metallic phong 0.8 phong_size 30 diffuse 0.6 brilliance 3 } interior { ior 2 } }
sphere { 1.4*x, 1.2 pigment { rgb <0.3, 0.6, 0.9> } finish { fresnel 0.7 specular 0.8 roughness 0.03 metallic 0.5 diffuse 0.6, 0.2 } interior { ior 1.7 } }
