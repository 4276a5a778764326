// mistake in line 2: `^` for a power
#declare A = 2^3;
sphere { 0, 2 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
