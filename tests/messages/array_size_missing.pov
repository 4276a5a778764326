// mistake in line 2: an array without its size
#declare A = array { 1, 2 };
