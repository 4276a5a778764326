// mistake in line 3: a comma after the last number, as from version 3.8 on
#version 3.7;
sphere { 0, 1 matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0,> }
