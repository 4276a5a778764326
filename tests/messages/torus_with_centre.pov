// mistake in line 2: a centre in a torus
torus { <0, 0, 0>, 1, 0.3 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
