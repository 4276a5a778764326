// mistake in line 2: the bracket before a vector is missing
sphere { 0, 1 pigment { rgb 0.9, 0.7, 0.4> } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
