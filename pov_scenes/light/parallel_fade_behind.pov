// A parallel light that fades lights what lies behind it too, but where the power of a negative distance is no number.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -8> look_at 0 angle 45 }
light_source { <0, 2, 0>, rgb 0.7 parallel point_at <1, 0, 0> fade_distance 3 fade_power 1.5 }
light_source { <0, 2, 0>, rgb <0.4, 0.2, 0> parallel point_at <1, 0, 0.2> fade_distance 3 fade_power 2 }
plane { y, -1 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-2.5, 0, 0>, 1 pigment { rgb <1, 0.6, 0.3> } }
sphere { <2.5, 0, 0>, 1 pigment { rgb <0.5, 0.6, 1> } }
