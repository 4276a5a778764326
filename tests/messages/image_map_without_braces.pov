// mistake in line 2: a picture without braces
sphere { 0, 1 pigment { image_map "a.png" } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
