// Turbulence varies the thickness of a film.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sphere { <0, 1, 0>, 1 scale 1.4 pigment { rgb <0.8, 0.7, 0.6> } finish { irid { 0.5 thickness 0.5 turbulence 0.8 } } }
