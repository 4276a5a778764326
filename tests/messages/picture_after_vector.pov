// doubt in line 4: a vector before a picture says nothing any more
#version 3.7;
camera { location <0, 1, -4> look_at 0 }
sphere { 0, 1 pigment { image_map { <1, -1, 0> png "pov_scenes/texture/images/rgb.png" } } }
light_source { <2, 4, -5>, 1 }
