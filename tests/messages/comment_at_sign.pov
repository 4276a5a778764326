// mistake in line 2: a comment beside the sign
camera { location = /* far */ -5*z look_at 0 }
