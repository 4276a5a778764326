// mistake in line 2: a texture in a texture
sphere { 0, 1 texture { texture { pigment { rgb 1 } } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
