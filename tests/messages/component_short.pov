// mistake in line 3: the component of a colour in one letter
#declare C = rgb x;
#declare A = C.r;
