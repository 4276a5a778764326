// mistake in line 2: a fraction in an exponent
sphere { 0, 1e-3.5 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
