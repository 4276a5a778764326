// mistake in line 2: a rotation by nothing
box { -1, 1 rotate }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
