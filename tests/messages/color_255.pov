// mistake in line 2: channels from 0 to 255 without brackets
sphere { 0, 1 pigment { color 255, 128, 0 } }
