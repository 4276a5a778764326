// A sky parallel to the view keeps the right vector as it was.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 6, 0> look_at 0 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-0.5, -0.9, -0.8>, <1, 0.4, 0.3> pigment { rgb <0.9, 0.5, 0.4> } }
