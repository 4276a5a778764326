// mistake in line 3: an object for a radius
#declare Ball = sphere { 0, 1 }
sphere { 0, Ball }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
