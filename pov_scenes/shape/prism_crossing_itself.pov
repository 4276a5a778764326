// A star whose outline crosses itself is hollow where it winds twice.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
prism { -0.3, 0.3, 6, <0, 1>, <0.59, -0.81>, <-0.95, 0.31>, <0.95, 0.31>, <-0.59, -0.81>, <0, 1> rotate <-60, 10, 0> pigment { rgb <0.8, 0.5, 0.2> } }
