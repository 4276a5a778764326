// Bricks lie in mortar; the default size is 8 by 3 by 4.5.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-1.3, -1, -0.8>, <1.3, 0.8, 0.8> rotate 30*y pigment { brick rgb 0.8, rgb <0.6, 0.2, 0.1> scale 0.11 } }
