// mistake in line 3: a declared texture without `texture { }`
#declare T = texture { pigment { rgb 1 } }
sphere { 0, 1 T }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
