// mistake in line 2: an axis and an angle
sphere { 0, 1 rotate <0, 1, 0> 45 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
