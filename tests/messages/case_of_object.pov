// mistake in line 3: a name that differs by capitals, and is a word of other programs
#declare Ball = sphere { 0, 1 }
object { ball }
