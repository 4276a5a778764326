// mistake in line 3: an include file that leaves a block open
#include "open_union.inc"
box { 0, 1 }
