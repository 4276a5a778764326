// mistake in line 2: vectors of a camera without brackets
camera { location 0 2 -5 look_at 0 0 0 }
sphere { 0, 1 }
light_source { <4, 6, -8>, rgb 1 }
