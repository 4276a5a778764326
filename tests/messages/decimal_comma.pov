// mistake in line 2: a decimal comma
sphere { <0, 0, 0>, 0,5 }
