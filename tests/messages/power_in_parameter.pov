// mistake in line 2: the power of a number
sphere { 0, 2^3 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
