// mistake in line 2: the head of a loop of C
#for (I = 0; I <= 9; I++)
  sphere { I*x, 1 pigment { rgb 1 } }
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
