// mistake in line 4: the brace before the declaration of line 3 is missing
#declare T1 = texture { pigment { rgb 1 }
#declare T2 = texture { pigment { rgb 0 } }
sphere { 0, 1 texture { T1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
