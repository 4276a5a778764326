// mistake in line 2: a raised digit behind parentheses
#declare A = (1 + 2)²;
