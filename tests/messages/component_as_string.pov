// mistake in line 3: a component in place of a string
#declare V = <1, 2, 3>;
#debug V.x
