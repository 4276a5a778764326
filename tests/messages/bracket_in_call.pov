// mistake in line 2: a vector that is not closed in a call
sphere { 0, vlength(<1, 2, 3) pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
