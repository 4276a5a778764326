// mistake in line 3: the comma before a vector whose first name is one of HTML
#declare p = 2;
sphere { 0, 1 <p, 0, 0> }
