// mistake in line 2: a function without parentheses
#declare A = sin 30;
