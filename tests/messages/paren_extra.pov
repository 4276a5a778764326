// mistake in line 2: one parenthesis too many
#declare A = sin(radians(45)));
sphere { 0, A pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
