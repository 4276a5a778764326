// mistake in line 2: decimal commas, with semicolons between components
sphere { 0, 1 translate <1,5; 2,5; -3> }
