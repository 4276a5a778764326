// mistake in line 2: a vector without components
sphere { <>, 1 }
