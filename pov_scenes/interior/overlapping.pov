// Two glasses that overlap without one holding the other.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-0.45, 0, 0>, 0.8 pigment { rgbf <1, 0.9, 0.8, 0.9> } interior { ior 1.3 } }
sphere { <0.45, 0.1, -0.2>, 0.8 pigment { rgbf <0.8, 0.9, 1, 0.9> } interior { ior 1.6 } }
