// mistake in line 3: a number for a string
#declare N = 3;
#debug N
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
