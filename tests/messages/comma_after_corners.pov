// mistake in line 2: a comma before a transform
box { -1, 1, rotate 45*y }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
