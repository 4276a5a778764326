// mistake in line 4: the file claims to hold far more pixels than its few bytes can
#version 3.7;
camera { location <0, 1, -4> look_at 0 }
sphere { 0, 1 pigment { image_map { pgm "picture_cut_off.pgm" } } }
light_source { <2, 4, -5>, 1 }
