// mistake in line 3: a condition without parentheses that begins with a macro
#macro F(X) X*2 #end
#if F(1) > 0
  sphere { 0, 1 pigment { rgb 1 } }
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
