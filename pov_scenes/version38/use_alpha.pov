// `use_alpha` lets transparency take from highlights and reflection as well.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sky_sphere { pigment { gradient y color_map { [0 rgb 0.2] [1 rgb <0.4, 0.7, 1>] } } }
#declare F = finish { diffuse 0.5 specular 0.6 roughness 0.05 phong 0.3 phong_size 10 reflection 0.3 }
sphere { <-1.5, 0.8, 0>, 0.8 pigment { rgbt <1, 0.6, 0.3, 0.7> } finish { F } }
sphere { <1.5, 0.8, 0>, 0.8 pigment { rgbt <1, 0.6, 0.3, 0.7> } finish { F use_alpha on } }
sphere { <-1.5, -1, 0>, 0.8 pigment { rgbf <1, 0.6, 0.3, 0.7> } finish { F use_alpha } }
sphere { <1.5, -1, 0>, 0.8 pigment { rgbf <1, 0.6, 0.3, 0.7> } finish { F use_alpha off } }
