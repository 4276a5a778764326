// mistake in line 2: a unit after an angle
sphere { 0, 1 rotate 45 deg }
