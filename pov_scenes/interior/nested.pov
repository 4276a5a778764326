// An air bubble in glass in water: each border bends by the ratio of its two sides.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1.2 pigment { rgbf <0.9, 0.95, 1, 0.95> } interior { ior 1.33 } }
sphere { <0.1, 0, -0.2>, 0.8 pigment { rgbf <0.95, 1, 0.9, 0.95> } interior { ior 1.6 } }
sphere { <0.1, 0.1, -0.3>, 0.3 pigment { rgbf <1, 0.9, 0.9, 0.95> } interior { ior 1 } }
