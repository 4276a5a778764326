// mistake in line 2: a semicolon before the step
#for (I, 0, 10; 2) sphere { I*x, 0.3 pigment { rgb 1 } } #end
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
