// mistake in line 2: the body of a function without braces
#declare F = function(x, y) x + y;
sphere { 0, F(1, 2) pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
