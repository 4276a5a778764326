// mistake in line 3: a texture for a pigment
#declare T = texture { pigment { rgb 1 } }
sphere { 0, 1 pigment { T } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
