// mistake in line 2: a sphere without a radius
sphere { 0 pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
