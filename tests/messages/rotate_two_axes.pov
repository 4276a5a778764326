// mistake in line 2: two rotations after one word
sphere { 0, 1 rotate 45*y 30*x }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
