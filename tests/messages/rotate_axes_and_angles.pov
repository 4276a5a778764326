// mistake in line 2: axes and angles side by side
sphere { 0, 1 pigment { rgb 1 } rotate x 90 y 45 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
