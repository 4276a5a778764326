// Eggs: wide below, wide above, both alike, and one whose top takes all.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
ovus { 0.6, 0.3 rotate 20*x translate <-1.8, 0.2, 0> pigment { rgb <0.8, 0.5, 0.2> } }
ovus { 0.4, 0.6 rotate <-30, 0, 20> translate <-0.5, 0, 0> pigment { rgb <0.2, 0.5, 0.8> } finish { phong 0.5 } }
ovus { 0.5, 0.5 rotate -60*z translate <0.6, 0.5, 0> pigment { rgb <0.5, 0.8, 0.3> } }
ovus { 0.3, 0.7 translate <1.9, -0.2, 0> pigment { rgb <0.7, 0.3, 0.6> } }
ovus { 0.4, 0.1 rotate 70*z translate <0.7, -0.8, -0.8> pigment { rgb <0.9, 0.8, 0.2> } }
