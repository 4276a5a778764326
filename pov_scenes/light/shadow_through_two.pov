// Two filters behind each other multiply.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 4, -6> look_at 0 angle 38 }
light_source { <0, 10, 0>, rgb 1 }
plane { y, -1 pigment { rgb 0.9 } }
box { <-1.5, 0, -0.8>, <0.5, 0.1, 0.8> pigment { rgbf <1, 1, 0.1, 0.95> } }
box { <-0.5, 0.6, -0.6>, <1.5, 0.7, 0.6> pigment { rgbf <0.1, 1, 1, 0.95> } }
