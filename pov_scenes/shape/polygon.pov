// Polygons: a letter with a hole, a tilted star that crosses itself, two that share an edge.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
polygon { 12, <-0.6, -0.8>, <-0.3, -0.8>, <0, 0>, <0.3, -0.8>, <0.6, -0.8>, <0.1, 0.8>, <-0.6, -0.8>, <0, 0.1>, <-0.1, 0.3>, <0, 0.5>, <0.1, 0.3>, <0, 0.1> translate <-1.7, 0.2, 0> pigment { rgb <0.8, 0.5, 0.2> } }
polygon { 6, <0, 0, 1>, <0.59, 0, -0.81>, <-0.95, 0, 0.31>, <0.95, 0, 0.31>, <-0.59, 0, -0.81>, <0, 0, 1> rotate <-50, 20, 0> translate <0.2, 0.4, 0> pigment { rgb <0.2, 0.5, 0.8> } }
polygon { 4, <1, -0.6, 0>, <1.7, 0.9, 0.3>, <0.8, 0.8, 0.5>, <1, -0.6, 0> pigment { rgb <0.5, 0.8, 0.3> } }
polygon { 3, <1, -0.6, 0>, <2, -0.4, 0>, <1.7, 0.9, 0.3> pigment { rgb <0.7, 0.3, 0.6> } }
polygon { 4, <-1, -1, -0.5>, <0, -1, -1>, <0.5, -0.9, 0.5>, <-1, -1, 0.4> pigment { rgb <0.9, 0.2, 0.2> } }
