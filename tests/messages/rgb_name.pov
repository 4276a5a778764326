// mistake in line 2: a colour of an include file that is not included
sphere { 0, 1 pigment { Red } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
