// `grey` is `gray`, in colours and in functions.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare C = rgb <1, 0.5, 0.2>;
#declare F = function { pigment { checker rgb C, rgb 1 scale 0.5 } }
sphere { 0, C.grey * 1.7 pigment { function { F(x, y, z).grey } color_map { [0 rgb x] [1 rgb y] } } }
