// mistake in line 2: #endmacro
#macro A(X)
  sphere { X, 1 pigment { rgb 1 } }
#endmacro
A(0)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
