// mistake in line 2: `angle` for a spotlight
light_source { <4, 6, -8>, rgb 1 spotlight angle 20 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
