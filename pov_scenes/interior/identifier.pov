// A declared interior, used as it is and extended.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Clear = interior { ior 1.4 };
sphere { <-1, 0, 0>, 0.8 pigment { rgbf 1 } interior { Clear } }
sphere { <1, 0, 0>, 0.8 pigment { rgbf 1 } interior { Clear fade_distance 0.5 fade_power 1 } }
