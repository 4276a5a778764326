// mistake in line 2: a camera that looks at itself
camera { location 1 look_at 1 }
sphere { 0, 1 }
