// mistake in line 3: a choice without its second value
#declare B = 1;
#declare A = B ?: 4;
