// mistake in line 2: a word of cameras in a spotlight
light_source { <0, 9, 0>, rgb 1 spotlight look_at 0 radius 5 }
