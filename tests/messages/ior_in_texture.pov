// mistake in line 2: `ior` in a texture
sphere { 0, 1 texture { pigment { rgb 1 } ior 1.5 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
