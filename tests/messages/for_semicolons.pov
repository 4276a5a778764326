// mistake in line 2: a loop of C
#for (I = 0; I < 3; I++) sphere { 0, 1 } #end
