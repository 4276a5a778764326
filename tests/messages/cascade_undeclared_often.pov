// mistake in line 3: a name that is used often and declared nowhere
#for (I, 1, 3)
  sphere { I*x, Size }
#end
sphere { 0, Size }
box { -Size, Size }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
