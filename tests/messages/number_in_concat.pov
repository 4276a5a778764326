// mistake in line 2: a number in `concat`
#declare S = concat("a", 3)
#debug S
sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
