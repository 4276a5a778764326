// mistake in line 2: no `;` behind a declared number
#declare R = 2
sphere { 0, R }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
