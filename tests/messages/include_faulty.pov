// mistake in line 1: a mistake in line 1 of a file that is included twice over
#include "outer.inc"
sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
