// mistake in line 2: `=` behind a word
sphere { 0, 1 finish { ambient = 0.2 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
