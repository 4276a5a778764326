// mistake in line 2: a sign before a block
sphere { 0, 1 pigment = { rgb 1 } }
