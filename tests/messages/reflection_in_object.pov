// mistake in line 2: `reflection` in an object
sphere { 0, 1 pigment { rgb 1 } reflection 0.5 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
