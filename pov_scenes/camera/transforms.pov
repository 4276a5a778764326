// Transforms in a camera act after look_at, in their order, wherever they stand.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { rotate 25*y location <0, 2, -6> translate <0.5, 0.2, 0> look_at 0 angle 38 rotate 5*z }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { -0.8, 0.8 pigment { rgb <0.4, 0.8, 0.8> } }
