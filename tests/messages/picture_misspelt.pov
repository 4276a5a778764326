// mistake in line 2: a misspelt picture
sphere { 0, 1 pigment { image_map { pgm "pictur.pgm" } } }
