// mistake in line 3: two indices in one pair of brackets
#declare A = array[2][2] { { 1, 2 }, { 3, 4 } }
sphere { 0, A[1, 1] pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
