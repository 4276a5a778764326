// mistake in line 2: a light without a colour
light_source { <1, 2, 3> }
sphere { 0, 1 }
camera { location -5*z }
