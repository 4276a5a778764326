// mistake in line 3: the result of a division by zero as a radius
#declare D = 0;
sphere { 0, 1/D }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
