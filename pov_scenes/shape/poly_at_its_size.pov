// Polynomials with roots exactly as far from the foot of the perpendicular as the surface is large: every ray near the
// axis meets these planes there.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -9> right 12*x up 9*y look_at 0 }
light_source { <5, 9, -20> 1 }
#macro Place(X, Y) pigment { rgb <.5 + X/10, .5, .5 - Y/10> } translate <X, Y, 0> clipped_by { sphere { <X, Y, 0>, 1.4 } } #end
// z = 1 and z = -1, with either sign, then both of them
poly { 2, <0,0,0,0,0,0,0, 0,1,-1> Place(-4, 3) }
poly { 2, <0,0,0,0,0,0,0, 0,1,1> Place(-1, 3) }
poly { 2, <0,0,0,0,0,0,0, 0,-1,1> Place(2, 3) }
poly { 2, <0,0,0,0,0,0,0, 0,-1,-1> Place(5, 3) }
poly { 2, <0,0,0,0,0,0,0, 1,0,-1> Place(-4, 0) }
poly { 2, <0,0,0,0,0,0,0, -1,0,1> Place(-1, 0) }
cubic { <0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0, 1,0,0,-1> Place(2, 0) }
cubic { <0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0, -1,0,1,0> Place(5, 0) }
quartic { <0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 1,0,0,0,-1> Place(-4, -3) }
quartic { <0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,1,0,-1> Place(-1, -3) }
quartic { <0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 1,0,-5,0,4> Place(2, -3) }
poly { 2, <1,0,0,0,1,0,0,1,0,-1> Place(5, -3) }
