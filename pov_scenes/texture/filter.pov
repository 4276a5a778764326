// A filtering colour tints what is behind it and the light of its shadow.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1, 0, 0>, 0.9 pigment { rgbf <0.9, 0.3, 0.2, 0.8> } }
box { <0.3, -1, -0.6>, <1.5, 0.6, 0.2> pigment { color rgb <0.2, 0.8, 0.4> filter 0.6 } }
