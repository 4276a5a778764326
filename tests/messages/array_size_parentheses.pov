// mistake in line 2: the size of an array in parentheses
#declare A = array(2) { 1, 2 };
