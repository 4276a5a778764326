// mistake in line 2: a degree sign
sphere { 0, 1 rotate <0, 45°, 0> }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
