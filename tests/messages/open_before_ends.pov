// mistake in line 2: `open` before the ends of a cylinder
cylinder { open 0, y, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
