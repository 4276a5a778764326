// mistake in line 2: an undeclared name for a radius
sphere { 0, r pigment { rgb 1 } }
