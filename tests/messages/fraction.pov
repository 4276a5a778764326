// mistake in line 2: a fraction as one letter
sphere { 0, ½ pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
