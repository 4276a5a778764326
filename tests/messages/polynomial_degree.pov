// mistake in line 3: a term of a higher degree
camera { location -5*z look_at 0 }
polynomial { 2, xyz(2, 0, 0): 1, xyz(1, 1, 1): 1 }
light_source { <4, 6, -8>, rgb 1 }
