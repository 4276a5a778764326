// mistake in line 2: names before the parameters of a shape
sphere { center <0, 0, 0>, radius 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
