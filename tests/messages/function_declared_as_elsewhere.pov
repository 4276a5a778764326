// mistake in line 2: parameters before `=`
#declare F(x) = x*2;
sphere { 0, F(1) }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
