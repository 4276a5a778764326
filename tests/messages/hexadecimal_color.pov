// mistake in line 2: a colour as in HTML
sphere { 0, 1 pigment { color #ff8000 } }
