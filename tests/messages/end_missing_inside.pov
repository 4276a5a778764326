// mistake in line 2: no `#end` for the `#if` of line 3, as the indentation shows
#for (I, 0, 3)
  #if (I > 1)
    sphere { I*x, 1 pigment { rgb 1 } }
#end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
