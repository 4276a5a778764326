// mistake in line 2: a short colour of web pages
sphere { 0, 1 pigment { rgb #f80 } }
