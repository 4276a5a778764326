// mistake in line 4: an inner texture without an outer one
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
sphere { 0, 1 interior_texture { pigment { rgb <1, 0, 0> } } }
