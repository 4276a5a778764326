// mistake in line 2: a folder in place of an include file
#include "library"
