// mistake in line 2: a mistake in a macro, told once
#macro A(X) sphere { X, 1 }} #end
A(0)
A(1)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
