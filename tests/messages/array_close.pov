// mistake in line 3: the brace behind the items of an array is missing
#declare A = array[2] { 1, 2
sphere { 0, A[1] pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
