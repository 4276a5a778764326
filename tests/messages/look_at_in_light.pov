// mistake in line 2: a word of cameras in a light
light_source { <0, 9, 0>, rgb 1 look_at 0 }
