// mistake in line 3: a declared transform without `transform { }`
#declare T = transform { rotate 45*y translate x }
box { -1, 1 T }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
