// mistake in line 2: the bracket behind an entry is missing
sphere { 0, 1 pigment { bozo color_map { [0 rgb 0] [0.5 rgb 1 [1 rgb 0] } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
