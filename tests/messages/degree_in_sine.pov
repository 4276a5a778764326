// mistake in line 2: a degree sign in a function
#declare A = sin(45°);
