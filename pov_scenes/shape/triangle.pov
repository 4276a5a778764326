// Triangles are lit from both sides; the second is turned round.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
triangle { <-2, -0.9, 0>, <-0.2, -0.9, 0.4>, <-1.2, 0.9, 0.2> pigment { rgb <0.9, 0.4, 0.3> } }
triangle { <2, -0.9, 0>, <0.2, -0.9, 0.4>, <1.2, 0.9, 0.2> pigment { rgb <0.3, 0.4, 0.9> } }
