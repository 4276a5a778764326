// mistake in line 3: the same without its capital
#include "colors.inc"
sphere { 0, 1 pigment { color gold } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
