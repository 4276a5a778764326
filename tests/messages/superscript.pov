// mistake in line 3: a power in small digits
#declare R = 2;
#declare A = 3*R²;
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
