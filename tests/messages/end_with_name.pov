// mistake in line 3: the name of a macro behind #end
#macro A(X)
  sphere { X, 1 pigment { rgb 1 } }
#end A
A(0)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
