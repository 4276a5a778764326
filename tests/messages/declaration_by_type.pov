// mistake in line 2: a type for `#declare`
float Size = 1;
