// mistake in line 4: a reserved word as key after a point
#version 3.8;
#declare D = dictionary { ["red"]: 0.5, .n: 1 };
sphere { 0, D.red }
