// mistake in line 2: a choice without parentheses
#declare A = 1 > 2 ? 3 : 4;
