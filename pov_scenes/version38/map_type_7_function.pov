// `map_type 7` of an image that a function gives, from all sides.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Ball(At, Turn) sphere { 0, 1 pigment { image_map { function 64, 64 { pigment { checker rgb 1, rgb <0.2, 0.4, 1> scale 0.125 } } map_type 7 } } rotate Turn translate At finish { emission 0.6 diffuse 0.2 } } #end
Ball(<-1.2, 1, 0>, 0) Ball(<1.2, 1, 0>, 180*y) Ball(<-1.2, -1, 0>, 90*y) Ball(<1.2, -1, 0>, 90*x)
