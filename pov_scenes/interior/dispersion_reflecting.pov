// Split light is reflected in its colours.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [1 rgb <0.2, 0.4, 0.9>] } } }
global_settings { max_trace_level 8 }
sphere { <0, 1, 0>, 1 pigment { rgbf <0.9, 0.9, 1, 0.9> } interior { ior 1.6 dispersion 1.08 } finish { ambient 0 diffuse 0 reflection { 0.05, 1 fresnel } conserve_energy } }
sphere { <-1, 0.4, -1.5>, 0.4 pigment { rgb <0.8, 0.2, 0.2> } }
