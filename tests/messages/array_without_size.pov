// mistake in line 2: an array without `array`
#declare A = {1, 2, 3};
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
