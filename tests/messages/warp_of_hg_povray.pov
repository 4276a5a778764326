// mistake in line 3: a warp of HG-POV
#version 3.8;
sphere { 0, 1 pigment { bozo warp { disc } } }
