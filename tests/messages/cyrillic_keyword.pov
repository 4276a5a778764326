// mistake in line 2: a Cyrillic letter in a keyword
sphеre { 0, 1 }
