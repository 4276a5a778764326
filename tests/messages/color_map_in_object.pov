// mistake in line 2: a colour map in the object itself
sphere { 0, 1 color_map { [0 rgb 0] [1 rgb 1] } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
