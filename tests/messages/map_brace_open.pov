// mistake in line 2: the brace before the entries is missing
sphere { 0, 1 pigment { bozo color_map [0 rgb 0] [1 rgb 1] } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
