// mistake in line 2: the letter O
sphere { 0, 1.O pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
