// mistake in line 3: a factor without `*`
#declare R = 2;
sphere { 0, 2R }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
