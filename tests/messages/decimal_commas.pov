// mistake in line 2: decimal commas in a vector
sphere { <0,5, 1,2, 3,0>, 1 }
