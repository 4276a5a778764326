// mistake in line 2: the word "not" for `!`
#if (not 0) sphere { 0, 1 } #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
