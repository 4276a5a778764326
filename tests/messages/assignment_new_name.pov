// mistake in line 2: a new name without #declare
Radius = 2;
sphere { 0, Radius }
