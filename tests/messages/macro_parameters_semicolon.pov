// mistake in line 2: a semicolon between parameters
#macro A(R; S) sphere { 0, R*S pigment { rgb 1 } } #end
A(1, 2)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
