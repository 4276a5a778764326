// mistake in line 2: the quote before the name is missing behind a no-break space
#include colors.inc"
sphere { 0, 1 }
