// mistake in line 2: an include file that is missing, and what it would have declared
#include "metalls.inc"
sphere { 0, 1 texture { T_Gold_1A } }
box { -1, 1 texture { T_Gold_2A } rotate Angle*y }
Nice_Macro(1)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
