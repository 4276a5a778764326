// mistake in line 2: both ends before the radii of a cone
cone { <0, 0, 0>, <0, 1, 0>, 1, 0.5 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
