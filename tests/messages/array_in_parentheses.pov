// mistake in line 3: an index in parentheses
#declare A = array[3] {1, 2, 3}
sphere { 0, A(1) }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
