// mistake in line 2: the word of another program
camera { position -5*z fov 60 }
sphere { 0, 1 pigment { rgb 1 } }
