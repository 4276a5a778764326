// mistake in line 2: a file without quotes
#include colors.inc
