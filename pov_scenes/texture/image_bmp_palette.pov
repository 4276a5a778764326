// BMP files with palettes keep their indices, for `transmit`, for textures and for bumps; 32 bits hold alpha.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.1, 0.53, -6> look_at <0, 0.2, 0> angle 45 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -2 pigment { checker rgb 0.2 rgb 1 scale 0.3 } finish { ambient 1 diffuse 0 } }
plane { y, -1.3 texture { material_map { bmp "images/runs8.bmp" texture { pigment { rgb x } } texture { pigment { rgb y } } texture { pigment { rgb z } } } rotate 90*x scale 2 } }
box { <-2, -1, 0>, <-0.7, 0.3, 0.1> pigment { image_map { bmp "images/four_bits.bmp" transmit 1, 0.7 filter 3, 0.5 } } }
box { <-0.6, -1, 0>, <0.6, 0.3, 0.1> pigment { image_map { bmp "images/alpha.bmp" } } }
box { <0.7, -1, 0>, <2, 0.3, 0.1> pigment { rgb 0.8 } normal { bump_map { bmp "images/runs4.bmp" use_index bump_size 0.3 } } }
sphere { <-0.8, 1.1, 0>, 0.7 pigment { image_map { bmp "images/runs4.bmp" map_type 1 interpolate 2 } } }
sphere { <0.8, 1.1, 0>, 0.7 pigment { image_pattern { bmp "images/runs8.bmp" map_type 1 } color_map { [0 rgb 0] [1 rgb 1] } } }
