// mistake in line 3: a product without its sign
#declare A = 2;
#declare B = 3 A;
