// mistake in line 2: the colour of a light before its location
light_source { rgb 1, <0, 5, 0> }
