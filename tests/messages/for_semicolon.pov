// mistake in line 2: `=` in the head of a `#for`
#for (I = 1, 3)
  sphere { I, 1 }
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
