// mistake in line 2: a shape without braces
sphere { 0, 1 clipped_by plane { y, 0 } pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
