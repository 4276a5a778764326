// mistake in line 2: an undeclared macro
Chair(0, 1)
