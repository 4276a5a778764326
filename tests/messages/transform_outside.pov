// mistake in line 2: a transform behind the object
sphere { 0, 1 } translate x
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
