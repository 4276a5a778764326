// mistake in line 2: a vector of six components
sphere { <1, 2, 3, 4, 5, 6>, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
