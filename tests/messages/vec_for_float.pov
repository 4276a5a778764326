// mistake in line 2: a vector for a radius
sphere { 0, <1, 2, 3> }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
