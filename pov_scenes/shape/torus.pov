// A torus lies in the plane of x and z; rotation and translation place it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
torus { 0.9, 0.3 pigment { rgb <0.9, 0.6, 0.2> } translate -0.5*y }
torus { 0.5, 0.15 rotate 80*x translate <1.2, 0.6, -0.5> pigment { rgb <0.2, 0.6, 0.9> } }
