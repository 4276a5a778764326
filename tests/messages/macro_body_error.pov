// mistake in line 3: a misspelt word inside a macro that is called twice
#macro Ball(R)
  sphere { 0, R pigmnt { rgb 1 } }
#end
Ball(1)
Ball(2)
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
