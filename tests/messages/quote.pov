// mistake in line 2: no closing quote behind the name of a file
#include "colors.inc
sphere { 0, 1 }
#debug "done"
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
