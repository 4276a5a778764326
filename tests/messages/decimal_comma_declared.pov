// mistake in line 2: a decimal comma in a declaration
#declare A = 1,5;
