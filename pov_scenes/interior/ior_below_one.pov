// An index below one spreads rays and reflects them totally at its rim.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 1 pigment { rgbf <0.9, 1, 0.9, 0.9> } interior { ior 0.7 } }
