// mistake in line 3: the name of an object as a word
#declare Ball = sphere { 0, 1 }
Ball { translate x }
