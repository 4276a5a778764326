// mistake in line 2: a prefix of a function
#declare A = Math.sin(1);
