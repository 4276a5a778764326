// mistake in line 2: a name without parentheses
#ifdef X sphere { 0, 1 } #end
