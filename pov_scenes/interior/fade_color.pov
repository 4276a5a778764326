// A fade colour tints thick glass; power 2, and a power of 1000 for the exponential law.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.1, 0, 0>, 0.9 pigment { rgbf 1 } interior { ior 1.3 fade_distance 0.6 fade_power 2 fade_color rgb <0.1, 0.6, 0.3> } }
sphere { <1.1, 0, 0>, 0.9 pigment { rgbf 1 } interior { ior 1.3 fade_distance 0.8 fade_power 1001 fade_color <0.9, 0.5, 0.1> } }
