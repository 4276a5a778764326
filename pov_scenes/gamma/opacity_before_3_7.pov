// Before 3.7 a filtering surface keeps more of its own light: filter counts by the largest channel.
#version 3.6;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1, 0, 0>, 0.8 pigment { rgbf <0.5, 0.2, 0.1, 0.8> } }
sphere { <1, 0, 0>, 0.8 pigment { rgbft <0.1, 0.3, 0.6, 0.5, 0.3> } }
