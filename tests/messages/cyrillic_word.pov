// mistake in line 2: a Cyrillic word
sphere { 0, 1 } сфера
