// mistake in line 2: semicolons between components
sphere { <0; 0; 0>, 1 }
