// mistake in line 2: a setting of the scene as a directive
#assumed_gamma 1.0
sphere { 0, 1 pigment { rgb 1 } }
