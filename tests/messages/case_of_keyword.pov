// mistake in line 3: a keyword for a name that differs by capitals
#declare Radius = 2;
sphere { 0, radius }
