// A vector or number before a picture is passed over.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -9>, 1 }
#declare Old = <1, 0, -1>;
box { -1, 1 pigment { image_map { <1, -1, 0> png "images/rgb.png" interpolate 2 } } rotate <20, 30, 0> }
plane { y, -2 pigment { image_map { 1 + 1 "images/rgb.ppm" map_type 0 } scale 2 rotate 90*x } normal { bump_map { x png "images/rgb.png" bump_size 2 } } }
sphere { 2*x, 0.7 pigment { image_pattern { -2 png "images/rgb.png" } color_map { [0 rgb x] [1 rgb 1] } } }
sphere { -2*x, 0.7 texture { material_map { Old png "images/palette.png" texture { pigment { rgb y } } texture { pigment { rgb z } } } } }
sphere { 1.7*y, 0.6 pigment { image_map { <1, -1> function 8, 8 { pigment { gradient x } } } } }
