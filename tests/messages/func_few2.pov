// mistake in line 2: a function without its second argument
sphere { 0, pow(2) }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
