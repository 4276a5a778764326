// mistake in line 2: the quotes of a word processor
#include “finish.inc”
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
