// mistake in line 3: a name with the sign of other languages
#declare R = 1;
sphere { 0, $R pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
