// Photons of a light so far away that the points where they hit have few digits left: behind glass they spread by
// POV-Ray's rounding, and those that the ring mirrors come in the order of it.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.0307 jitter 0 } }
camera { location <3, 3, -2.5> look_at <0.3, 0.2, 0.6> angle 50 }
light_source { <-0.7, 0.5, 0.83> * 150000, <3, 2.6, 1.8> photons { refraction on reflection on } }
plane { y, 0 pigment { rgb 0.7 } finish { ambient 0 } }
sphere { 0.24 * y, 0.24 pigment { rgbf 0.9 } interior { ior 1.5 } photons { target refraction on } translate <1, 0, -0.5> }
difference { cylinder { 0, 0.3*y, 0.7 } cylinder { -y, y, 0.65 } translate <-0.4,0,0.6> pigment { rgb <0.8,0.6,0.5> } finish { diffuse 0.3 reflection 0.7 } photons { target reflection on } }
