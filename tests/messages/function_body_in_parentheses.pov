// mistake in line 2: parentheses around the body of a function
#declare F = function(x) (x*2)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
