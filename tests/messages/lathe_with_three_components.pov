// mistake in line 2: points of a lathe with three components
lathe { linear_spline 3, <0, 0, 0>, <1, 1, 0>, <0, 2, 0> }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
