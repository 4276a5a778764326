// A mixed array has several dimensions, and its items may be arrays.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A = array mixed[2][2] { { 0.5, <1, 0, 0> }, { rgb <1, 0.6, 0.2>, array[2] { 0.3, 0.8 } } }
sphere { A[0][1] * 2, A[0][0] pigment { color A[1][0] } }
#declare Sizes = A[1][1];
sphere { -2*x, Sizes[1] }
sphere { -y, A[1][1][0] }
