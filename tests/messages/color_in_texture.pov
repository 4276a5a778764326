// mistake in line 2: a colour without a pigment
sphere { 0, 1 texture { color rgb <1, 0, 0> } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
