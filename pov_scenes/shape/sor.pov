// Surfaces of revolution, closed and open.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sor { 6, <0.2, -1.2>, <0.3, -0.8>, <0.7, -0.2>, <0.2, 0.4>, <0.4, 0.8>, <0.5, 1.2> rotate -25*x translate <-1.6, 0.3, 0> pigment { rgb <0.8, 0.5, 0.2> } }
sor { 6, <0.2, -1.2>, <0.3, -0.8>, <0.7, -0.2>, <0.2, 0.4>, <0.5, 0.8>, <0.9, 1.2> open rotate -30*x translate <0.1, 0.4, 0> pigment { rgb <0.2, 0.5, 0.8> } finish { phong 0.5 } }
sor { 5, <0, -1>, <0, -0.7>, <0.6, 0>, <0, 0.7>, <0, 1> rotate 50*z translate <1.7, 0.3, 0> pigment { rgb <0.5, 0.8, 0.3> } }
sor { 4, <0.5, -0.6>, <0.4, -0.3>, <0.4, 0.3>, <0.8, 0.5> open rotate <70, 20, 0> translate <0.9, -0.8, -0.8> pigment { rgb <0.7, 0.3, 0.6> } }
