// mistake in line 3: `+=` for `=`
#declare A = 5;
#declare A += 2;
sphere { 0, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
