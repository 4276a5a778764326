// Lamps brighter than one: each channel is clipped by itself at the end.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb <3, 1.5, 1> }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb <0.9, 0.8, 0.6> } }
