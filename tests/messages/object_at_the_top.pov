// mistake in line 3: an object that is only named
#declare Ball = texture { pigment { rgb 1 } }
Ball
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
