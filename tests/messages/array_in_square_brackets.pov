// mistake in line 2: an array in brackets
#declare A = [1, 2, 3];
sphere { 0, A[0] pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
