// mistake in line 2: a colour as a call, from 0 to 255
sphere { 0, 1 pigment { rgb(255, 128, 0) } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
