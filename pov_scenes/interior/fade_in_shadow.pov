// The shadow of fading glass is darker where the light's way through it is longer.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -6> look_at <0, -0.5, 0> angle 38 }
light_source { <0, 12, 0>, rgb 1 }
plane { y, -1 pigment { rgb 0.9 } }
sphere { <0, 0.4, 0>, 1 pigment { rgbf 1 } interior { fade_distance 0.7 fade_power 2 fade_color rgb <0.2, 0.3, 0.8> } }
