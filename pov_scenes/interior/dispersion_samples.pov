// Dispersion may split light into more colours, or only two.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [1 rgb <0.2, 0.4, 0.9>] } } }
sphere { <-1.3, 1, 0>, 1 pigment { rgbt 0.95 } interior { ior 1.5 dispersion 1.1 dispersion_samples 20 } finish { ambient 0 diffuse 0 } }
sphere { <1.3, 1, 0>, 1 pigment { rgbt 0.95 } interior { ior 1.5 dispersion 1.1 dispersion_samples 2 } finish { ambient 0 diffuse 0 } }
