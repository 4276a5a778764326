// mistake in line 2: the size of an array without brackets
#declare A = array 2;
