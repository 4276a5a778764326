// Without photons in the global settings, what objects do with them changes nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at <0, 0.8, 0> angle 45 }
light_source { <5, 8, -6>, rgb 1 }
plane { y, 0 pigment { checker rgb 0.9 rgb <0.3, 0.4, 0.5> } }
sphere { <0, 1, 0>, 1 pigment { rgbt <1, 1, 1, 0.8> } interior { ior 1.2 } photons { target 1.0 reflection on refraction on collect off } no_radiosity radiosity { importance 0.5 } }
