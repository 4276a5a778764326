// A film tints what is reflected as a whole inside glass, and mirror images before their exponent.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }
camera { location <0, 1, -7> look_at 0 angle 40 }
light_source { <3, 8, -4> rgb 1 }
sky_sphere { pigment { gradient y color_map { [0 rgb x] [1 rgb z] } } }
box { -0.9, 0.9 pigment { rgbf <0.2, 0.9, 0.7, 0.8> } finish { diffuse 0 ambient 0 irid { 0.4 thickness 0.2 } } interior { ior 1.5 } rotate 30 translate -1.5 * x }
sphere { 1.5 * x, 1 pigment { rgb 0.4 } finish { irid { 0.4 thickness 0.3 } reflection 0.5 reflection_exponent 0.8 } }
