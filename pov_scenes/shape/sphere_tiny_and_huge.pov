// Spheres of radius 0.002 to 1000 in one picture; the largest serves as the ground.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
sphere { <0, -1001, 0>, 1000 pigment { rgb <0.4, 0.6, 0.3> } }
sphere { <-1.6, -0.4, 0>, 0.6 pigment { rgb <0.8, 0.2, 0.2> } }
sphere { <-0.4, -0.85, -1>, 0.15 pigment { rgb <0.2, 0.2, 0.8> } }
sphere { <0.3, -0.97, -2>, 0.03 pigment { rgb <0.9, 0.9, 0.1> } }
sphere { <0.02, 1.99, -5.96>, 0.002 pigment { rgb <0.9, 0.4, 0.9> } }
sphere { <1.5, 0, 0>, 1 pigment { rgb <0.2, 0.7, 0.7> } }
