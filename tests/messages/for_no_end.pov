// mistake in line 2: no `#end` for the outer of two loops
#for (I, 0, 3)
  #for (J, 0, 3)
    sphere { <I, J, 0>, 1 }
  #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
