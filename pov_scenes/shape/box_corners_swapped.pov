// The corners of a box may be given in any order, also mixed over the axes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-0.2, -1, -0.6>, <-1.6, 0.7, 0.6> pigment { rgb <0.8, 0.5, 0.2> } }
box { <0.3, 0.4, 0.5>, <1.5, -1, -0.5> pigment { rgb <0.3, 0.5, 0.9> } }
