// mistake in line 2: a font that is not there
text { ttf "arial.ttf" "Hi" 0.1, 0 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
