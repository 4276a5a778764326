// mistake in line 2: fewer points than announced
lathe { linear_spline 3, <0, 0>, <1, 1> }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
