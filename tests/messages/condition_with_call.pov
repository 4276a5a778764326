// mistake in line 2: a condition with a call, without parentheses
#if sqrt(4) > 1 sphere { 0, 1 } #end
