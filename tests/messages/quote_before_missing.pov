// mistake in line 2: no quote before a name
#include colors.inc"
sphere { 0, 1 pigment { Red } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
