// mistake in line 2: two numbers for a vector
superellipsoid { 0.5, 0.5 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
