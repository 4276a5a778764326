// mistake in line 3: a misspelt name
#declare Radius = 2;
sphere { 0, Raduis }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
