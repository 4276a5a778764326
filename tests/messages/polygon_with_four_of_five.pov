// mistake in line 2: fewer corners than announced
polygon { 5, <0, 0>, <1, 0>, <1, 1>, <0, 0> }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
