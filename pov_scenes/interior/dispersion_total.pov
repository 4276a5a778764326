// Split light that is reflected as a whole is filtered, and beside it stands the ordinary mirror image.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 9 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [1 rgb <0.2, 0.4, 0.9>] } } }
box { <-1, 0.01, -1>, <1, 2, 1> rotate 33*y pigment { rgbt <1, 1, 1, 0.7> } interior { ior 1.5 dispersion 1.2 dispersion_samples 5 } finish { ambient 0 diffuse 0 reflection 0.2 } }
sphere { <0, 1, 0>, 0.3 pigment { rgb <0.9, 0.3, 0.2> } }
