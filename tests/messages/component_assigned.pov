// mistake in line 2: a value for a component
#declare V = <1, 2, 3>; #declare V.x = 3;
