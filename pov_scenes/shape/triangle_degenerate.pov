// Triangles without area are left out; their neighbours are drawn.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
triangle { <-2, 0, 0>, <0, 0, 0>, <2, 0, 0> pigment { rgb <1, 0, 0> } }
triangle { <1, 1, 0>, <1, 1, 0>, <2, 0, 0> pigment { rgb <1, 0, 0> } }
triangle { <-1, -0.8, 0>, <1, -0.8, 0>, <0, 0.8, 0> pigment { rgb <0.2, 0.8, 0.6> } }
