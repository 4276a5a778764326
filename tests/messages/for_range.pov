// mistake in line 2: a range of numbers
#for (I in 0..10) sphere { I*x, 0.3 pigment { rgb 1 } } #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
