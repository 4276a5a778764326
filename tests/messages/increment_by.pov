// mistake in line 3: an increment of other languages
#declare I = 0;
I += 2;
