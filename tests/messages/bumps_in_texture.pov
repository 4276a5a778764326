// mistake in line 2: a bump pattern in a texture
sphere { 0, 1 texture { pigment { rgb 1 } bumps 0.5 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
