// mistake in line 2: a misspelt directive that opens a group
#foor (I, 0, 3)
  sphere { I*x, 1 pigment { rgb 1 } }
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
