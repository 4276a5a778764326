// mistake in line 2: a bracket after the first component
light_source { <-4 ), 6, -8>, rgb 0.8 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
