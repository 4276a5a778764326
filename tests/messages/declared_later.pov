// mistake in line 2: a name used above its declaration
sphere { 0, Radius }
#declare Radius = 2;
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
