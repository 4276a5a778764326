// Fade power one and three, with different distances.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-1.5, 1, -1>, rgb <1, 0.5, 0.4> fade_distance 0.7 fade_power 1 }
light_source { <1.5, 1, -1>, rgb <0.4, 0.5, 1> fade_distance 1.4 fade_power 3 }
plane { y, -1.01 pigment { rgb 0.9 } }
sphere { 0, 0.7 pigment { rgb 0.9 } }
