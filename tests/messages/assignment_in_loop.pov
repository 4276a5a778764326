// mistake in line 4: a counter without #declare
#declare I = 0;
#while (I < 3)
  I = I + 1;
#end
