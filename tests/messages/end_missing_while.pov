// mistake in line 5: no `#end` for a `#while`
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
#declare I = 0;
#while (I < 3)
  sphere { I, 1 }
  #declare I = I + 1;
