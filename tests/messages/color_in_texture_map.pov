// mistake in line 2: a colour in a map of textures
sphere { 0, 1 texture { marble texture_map { [0 pigment { rgb 0 }] [1 rgb 1] } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
