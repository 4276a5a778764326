// mistake in line 2: a block with a sign before it
sphere { 0, 1 pigment = rgb 1 }
