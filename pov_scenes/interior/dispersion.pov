// Dispersion splits white light into seven colours.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.9, 0.8, 0.6>] [1 rgb <0.2, 0.4, 0.9>] } } }
sphere { <-1.3, 1, 0>, 1 pigment { rgbt 0.95 } interior { ior 1.5 dispersion 1.1 } finish { ambient 0 diffuse 0 } }
box { <0.4, 0, -0.8>, <2, 1.8, 0.8> rotate 30*y pigment { rgbt 0.95 } interior { ior 1.4 dispersion 1.15 } finish { ambient 0 diffuse 0 } }
