// mistake in line 3: a number joined to a string
#declare N = 5;
#debug concat("N is ", N, "\n")
sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
