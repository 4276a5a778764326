// mistake in line 3: an assignment without #declare
#declare I = 0;
I = I + 1;
sphere { 0, I }
