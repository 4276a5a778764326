// mistake in line 2: `#case` as in C
#switch (1) #case 1: sphere { 0, 1 } #break #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
