// mistake in line 2: an array with more values than items
#declare A = array[2] { 1, 2, 3 }
sphere { 0, A[0] }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
