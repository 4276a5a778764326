// mistake in line 3: a texture without braces
#declare T = texture { pigment { rgb 1 } }
sphere { 0, 1 texture T }
