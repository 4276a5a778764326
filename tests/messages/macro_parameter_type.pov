// mistake in line 3: the type of a parameter
#macro A(float R) sphere { 0, R pigment { rgb 1 } } #end
A(1)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
