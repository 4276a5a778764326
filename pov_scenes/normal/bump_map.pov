// A picture gives the heights.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
#declare Dots = function { pigment { leopard scale 0.03 } }
sphere { 0, 1 pigment { rgb 0.8 } normal { bump_map { function 24, 20 { Dots(x, y, z).red } interpolate 2 bump_size 4 } scale 0.7 } }
plane { y, -1.07 pigment { rgb 0.6 } normal { bump_map { function 24, 20 { Dots(x, y, z).red } map_type 1 bump_size 3 } } }
