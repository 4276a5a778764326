// mistake in line 2: the suffix of a number in C
sphere { 0, 1.0f pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
