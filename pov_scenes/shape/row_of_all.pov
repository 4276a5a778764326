// All bounded solids in one picture, each hiding a part of the next.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <-4, 3, -7> look_at <0, -0.3, 0> angle 42 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-2.4, -0.2, -0.9>, 0.8 pigment { rgb <0.9, 0.3, 0.3> } }
box { <-1.9, -1, -0.6>, <-0.7, 0.5, 0.6> pigment { rgb <0.9, 0.7, 0.3> } }
cylinder { <0, -1, 0>, <0, 0.8, 0>, 0.55 pigment { rgb <0.5, 0.9, 0.3> } }
cone { <1.3, -1, 0.2>, 0.7, <1.3, 1.1, 0.2>, 0.1 pigment { rgb <0.3, 0.8, 0.9> } }
torus { 0.6, 0.2 rotate 70*x translate <2.5, -0.2, 0.4> pigment { rgb <0.6, 0.3, 0.9> } }
disc { <0.8, -0.4, -1.6>, <0.2, 1, -0.6>, 0.6, 0.2 pigment { rgb <0.8, 0.8, 0.8> } }
