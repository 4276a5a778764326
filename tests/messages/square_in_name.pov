// mistake in line 2: a raised digit in a name
#declare R² = 4;
