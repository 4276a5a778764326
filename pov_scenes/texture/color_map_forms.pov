// Colour maps: the old form with two positions, equal positions, entries out of order.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { gradient x color_map { [0, 0.4 color rgb 1 color rgb <1, 0, 0>] [0.4, 1.01 color rgb <0, 0, 1> color rgb 0] } } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { gradient y color_map { [0.2 rgb 1] [0.5 rgb <1, 0, 0>] [0.5 rgb <0, 1, 0>] [0.5 rgb <0, 0, 1>] [0.8 rgb 0] } } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { gradient x color_map { [0.9 rgb x] [0.2 rgb y] [0.5 rgb z] } } }
