// mistake in line 4: modifiers of an object in lines of their own
#declare Ball = sphere { 0, 1 }
Ball
  translate x
  scale 2
