// mistake in line 2: a semicolon between two objects on one line
sphere { 0, 1 }; box { 0, 1 }
sphere { 2, 1 }
