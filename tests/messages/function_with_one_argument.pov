// mistake in line 3: one argument of two
#declare F = function(x, y) { x + y }
sphere { 0, F(1) }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
