// mistake in line 2: a comment beside the name of a parameter
sphere { center /* here */ 0, 1 }
