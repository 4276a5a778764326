// mistake in line 2: a colour by its name in CSS
sphere { 0, 1 pigment { color tomato } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
