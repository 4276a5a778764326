// mistake in line 2: no `;` behind a declared number, before a directive
#declare R = 2
#declare S = 3;
sphere { 0, R }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
