// mistake in line 3: a component for a colour that differs by capitals
#declare Red = rgb x;
sphere { 0, 1 pigment { color red } }
