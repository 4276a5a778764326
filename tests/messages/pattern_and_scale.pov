// mistake in line 2: a pattern in an object, with a transform
sphere { 0, 1 gradient y scale 0.2 }
