// mistake in line 2: a word for the font that there is not
text { font "cyrvetic.ttf" "A" 1, 0 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
