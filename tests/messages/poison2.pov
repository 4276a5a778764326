// mistake in line 2: an undeclared name in a declared number that is used later
#declare R = 1 + Zork;
sphere { 0, R }
box { -R, R }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
