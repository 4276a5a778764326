// mistake in line 2: no `)` behind an argument
#declare A = sin(1;
sphere { 0, A }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
