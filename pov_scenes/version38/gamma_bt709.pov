// A colour of an image with `gamma bt709` or `bt2020` is decoded by that curve.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { -1.5*x, 1.3 pigment { image_map { png "../texture/images/rgb.png" gamma bt709 map_type 1 } } }
sphere { 1.5*x, 1.3 pigment { image_map { png "../texture/images/rgb.png" gamma bt2020 map_type 1 } } }
