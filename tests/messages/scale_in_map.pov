// mistake in line 2: a transform in a map
sphere { 0, 1 pigment { marble color_map { [0 rgb 0] [1 rgb 1] scale 2 } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
