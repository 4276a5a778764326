// mistake in line 3: a condition without parentheses
#declare A = 1;
#if A = 1 sphere { 0, 1 } #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
