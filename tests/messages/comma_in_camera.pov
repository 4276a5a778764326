// mistake in line 2: a comma in a camera
camera { location <0, 1, -5>, look_at 0 }
sphere { 0, 1 }
light_source { <4, 6, -8>, rgb 1 }
