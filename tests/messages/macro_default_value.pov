// mistake in line 2: a default value
#macro A(R = 1) sphere { 0, R pigment { rgb 1 } } #end
A(2)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
