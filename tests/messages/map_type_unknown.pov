// mistake in line 4: there is no map of this number
#version 3.7;
camera { location <0, 1, -4> look_at 0 }
sphere { 0, 1 pigment { image_map { png "pov_scenes/texture/images/rgb.png" map_type 3 } } }
light_source { <2, 4, -5>, 1 }
