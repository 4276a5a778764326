// mistake in line 2: a colour with its opacity
sphere { 0, 1 pigment { color rgba <1, 0, 0, 0.25> } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
