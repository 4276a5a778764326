// mistake in line 2: no `>` behind a vector in the camera
camera { location <0, 1, -5 look_at 0 }
sphere { 0, 1 }
