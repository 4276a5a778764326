// A cylinder with caps between two points, upright, lying and oblique.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
cylinder { <-1.4, -1, 0>, <-1.4, 0.8, 0>, 0.5 pigment { rgb <0.9, 0.4, 0.2> } }
cylinder { <-0.3, -0.6, -1>, <0.9, -0.6, -1.4>, 0.35 pigment { rgb <0.3, 0.8, 0.4> } }
cylinder { <0.5, -0.3, 0.7>, <1.9, 1, 0.2>, 0.4 pigment { rgb <0.4, 0.4, 0.9> } }
