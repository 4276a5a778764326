// mistake in line 2: the letter of pi behind a number
sphere { 0, 2π }
