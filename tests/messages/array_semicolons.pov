// mistake in line 2: semicolons between the items of an array
#declare A = array[2] { 1; 2 };
