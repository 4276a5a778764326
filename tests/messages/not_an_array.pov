// mistake in line 3: an index behind a number
#declare A = 2;
sphere { 0, A[1] }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
