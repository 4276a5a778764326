// Size and mortar of bricks are free.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-1.3, -1, -0.8>, <1.3, 0.8, 0.8> rotate 30*y pigment { brick rgb <0.3, 0.3, 0.4>, rgb <0.9, 0.8, 0.6> brick_size <0.61, 0.37, 0.52> mortar 0.07 } }
