// mistake in line 2: a modifier before its pattern
sphere { 0, 1 pigment { turbulence 0.5 marble color_map { [0 rgb 0] [1 rgb 1] } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
