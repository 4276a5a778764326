// mistake in line 2: no semicolon before a directive that asks for the name
#declare R = 3
#if (1)
  #declare C = R;
#end
sphere { 0, R }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
