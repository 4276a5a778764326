// mistake in line 2: a line separator of Unicode
sphere { 0, 1 } box { 0, 1 }
