// mistake in line 3: a misspelt word inside a loop
#for (I, 1, 3)
  sphere { I, 1 pigmnt { rgb 1 } }
#end
box { -1, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
