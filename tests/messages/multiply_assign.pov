// mistake in line 4: an assignment by an operator, without `#declare`
#version 3.7;
#declare N = 2;
N *= N + 1;
sphere { 0, N pigment { rgb 1 } }
