// A light behind discs and outside inverse objects: its photons start in their interiors, however far away their boxes are.
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.03 } }
camera { location <0, 2.3, -4.5> look_at 0 }
light_source { <50, -35, -20>, 1 }
sphere { 0, 1 pigment { rgbt 1 } finish { reflection 0.2 } interior { ior 1.7 } photons { target refraction on reflection on } }
disc { 0, y, 2.2, 1.3 rotate <15, 0, -20> pigment { rgb <0.6, 0.4, 0.1> } interior { ior 1.2 } }
sphere { 3*z, 0.8 inverse pigment { rgb <0.2, 0.5, 0.8> } interior { ior 1.1 } }
