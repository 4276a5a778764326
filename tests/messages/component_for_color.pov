// mistake in line 2: a component for a colour
sphere { 0, 1 pigment { color red } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
