// Pavements whose parameters stand in any order among other modifiers, numbers modulo 256, bumps, and the defaults.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.4, 3, -4> look_at <0.3, 0, 0.2> angle 60 }
light_source { <-5, 8, -6>, rgb 1 }
#declare Tiles = pigment { pavement pattern 258 scale 0.4 number_of_tiles 259.7 rotate 20*y number_of_sides -252 color_map { [0 rgb <0.9, 0.5, 0.3>] [1 rgb 0.2] } }
plane { y, 0 pigment { Tiles } normal { pavement 0.4 number_of_sides 6 } }
box { <-1, 0, -0.5>, <1, 0.6, 0.5> texture { pavement number_of_sides 4 number_of_tiles 2 form 1 texture_map { [0.3 pigment { rgb <0.3, 0.6, 0.9> }] [0.7 pigment { rgb <0.9, 0.9, 0.5> }] } scale 0.3 rotate 90*x } }
sphere { <0, 1.2, 0>, 0.5 pigment { pavement scale 0.2 } }
