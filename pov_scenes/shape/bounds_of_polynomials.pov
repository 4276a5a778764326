// The bounds of a polynomial are tested, although it is no part of a combination; those of other shapes are not.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -12> look_at <0, 0.3, 0> angle 40 }
light_source { <5, 8, -9> 1 }
light_source { <-5, 8, -9> 0.3 }
plane { y, -2.2 pigment { checker rgb 1, rgb 0.7 } }
#default { pigment { rgb <1, 0.4, 0.3> } }
cubic { <0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,-1,0,1,0,-0.2> bounded_by { sphere { 0, 1 } } translate -3.2*x }
poly { 2, <1, 0, 0, 0, -1, 0, 0, 1, 0, -0.2> bounded_by { box { -1, 1 } } rotate <20, 30, 40> translate -1*x }
quartic { <1,0,0,0,2,0,0,-2,0,-1.04,0,0,0,0,0,0,0,0,0,0,1,0,0,-2,0,0.56,0,0,0,0,1,0,1.04,0,0.0784> bounded_by { sphere { 0, 1.2 } } rotate <90, 20, 0> translate 1.2*x }
torus { 0.7, 0.3 bounded_by { sphere { 0, 0.8 } } rotate -60*x translate 3.2*x }
