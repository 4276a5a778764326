// mistake in line 2: an angle that no camera has
camera { location -5*z angle 200 }
sphere { 0, 1 }
