// mistake in line 2: a word of lights in a camera
camera { location -5*z point_at 0 }
