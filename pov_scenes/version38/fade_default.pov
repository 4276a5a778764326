// Lights that fade by their power alone, and by a distance.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { y, -1 pigment { rgb 0.8 } }
sphere { 0, 1 pigment { rgb <0.9, 0.7, 0.5> } }
light_source { <-3, 2, -2>, rgb <2, 1, 1> fade_power 1 }
light_source { <3, 2, -2>, rgb <1, 1, 2> fade_power 2 fade_distance 2 }
