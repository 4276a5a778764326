// mistake in line 2: a word of other programs for brightness
light_source { <4, 6, -8>, rgb 1 intensity 2 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
