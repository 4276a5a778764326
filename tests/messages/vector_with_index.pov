// mistake in line 3: the component of a vector by its number
#declare V = <1, 2, 3>;
sphere { V, V[0] }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
