// mistake in line 2: a misspelt word in `finish`
sphere { 0, 1 finish { ambiant 0.2 diffuse 0.8 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
