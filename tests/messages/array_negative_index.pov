// mistake in line 4: an index below 0
#declare A = array[3] { 1, 2, 3 };
#declare I = -1;
sphere { 0, A[I] }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
