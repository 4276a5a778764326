// mistake in line 2: `location` in a light source
light_source { location <4, 6, -8> color rgb 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
