// mistake in line 2: a type before the name of a declaration
#declare float Size = 3;
