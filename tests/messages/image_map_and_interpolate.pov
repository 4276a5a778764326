// mistake in line 2: a picture without braces, with its parameters
sphere { 0, 1 pigment { image_map "a.png" interpolate 2 once } }
