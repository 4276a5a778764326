// A fading lamp loses strength with the square of the distance.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <0, 0.8, -0.5>, rgb 1.5 fade_distance 1 fade_power 2 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.2, -0.3, 0.3>, 0.6 pigment { rgb <0.9, 0.7, 0.5> } }
