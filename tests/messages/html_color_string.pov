// mistake in line 2: a colour of web pages as a string
sphere { 0, 1 pigment { color "#ff8000" } }
