// Outside of `image_map`, a `map_type` of no map is the flat one; the number is cut to a whole one first.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -9>, 1 }
sphere { <-1.2, 0, 0>, 1.1 pigment { rgb 1 } normal { bump_map { png "images/rgb.png" map_type 3 bump_size 3 } } }
sphere { <1.2, 0, 0>, 1.1 pigment { image_pattern { png "images/rgb.png" map_type -1.5 } color_map { [0 rgb x] [1 rgb y] } } }
sphere { <0, 1.7, 1>, 0.9 texture { material_map { png "images/palette.png" map_type 99 once texture { pigment { rgb x } } texture { pigment { rgb z } } } translate <-0.5, 1.2, 0> } }
plane { y, -1.1 pigment { image_pattern { png "images/rgb.png" map_type 1.9 } color_map { [0 rgb z] [1 rgb 1] } } }
