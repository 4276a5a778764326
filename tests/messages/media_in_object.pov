// mistake in line 2: `media` in the object itself
sphere { 0, 1 pigment { rgbt 1 } media { emission 1 } hollow }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
