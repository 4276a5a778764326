// A fading interior takes light by the way through it: thick glass is darker.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-1.4, -0.9, -0.2>, <-0.2, 0.8, 0> pigment { rgbf 1 } interior { ior 1.02 fade_distance 0.5 fade_power 1 } }
box { <0.2, -0.9, -1>, <1.4, 0.8, 0.6> pigment { rgbf 1 } interior { ior 1.02 fade_distance 0.5 fade_power 1 } }
