// mistake in line 2: a hexadecimal number
#declare A = 0xFF;
