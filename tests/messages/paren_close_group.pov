// mistake in line 2: no `)` behind a sum
#declare A = 2*(1 + 3;
sphere { 0, A }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
