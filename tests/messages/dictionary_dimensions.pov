// mistake in line 4: the dimensions of a dictionary
#version 3.8;
#declare D = dictionary { .a: 1, .b: 2 };
#for (I, 1, dimension_size(D, 1)) sphere { I * x, 1 } #end
