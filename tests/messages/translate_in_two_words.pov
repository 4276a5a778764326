// mistake in line 2: two vectors after one word
sphere { 0, 1 translate 2*x 3*y }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
