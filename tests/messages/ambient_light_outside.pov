// mistake in line 2: a setting of the scene outside of its block
ambient_light rgb 1
sphere { 0, 1 pigment { rgb 1 } }
