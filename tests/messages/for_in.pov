// mistake in line 2: a loop of other languages
#for I in 1 to 3 sphere { 0, 1 } #end
