// mistake in line 2: `no_shadow` in a texture
sphere { 0, 1 texture { pigment { rgb 1 } no_shadow } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
