// A cone with two radii, both ends capped, in three directions.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
cone { <-1.4, -1, 0>, 0.8, <-1.4, 0.8, 0>, 0.3 pigment { rgb <0.9, 0.4, 0.2> } }
cone { <0, 0.9, 0.5>, 0.7, <0.2, -0.8, 0.3>, 0.2 pigment { rgb <0.3, 0.8, 0.4> } }
cone { <0.9, -0.5, -1>, 0.5, <2, -0.4, 0>, 0.25 pigment { rgb <0.4, 0.4, 0.9> } }
