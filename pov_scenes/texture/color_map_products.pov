// Colours in a map that begin with a number, a bracket or a function, and old entries of two positions beside them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -9> look_at 0 right 8*x up 6*y }
#declare Sand = rgb <0.8, 0.7, 0.5>;
#declare Sky = rgb <0.4, 0.6, 0.9>;
#declare Half = 0.5;
#declare Flat = finish { ambient 1 diffuse 0 }
plane { z, 0 pigment { gradient x color_map { [0 0.3*Sand] [0.5, (Sky)] [1 2 - Sky] } scale 4 } finish { Flat } }
box { <-4, -3, -1>, <0, 0, -0.5> pigment { wrinkles color_map { [0 Half*Sky] [Half*0.5 pow(2, -2)*Sand] [1 .5*(Sand + Sky)] } } finish { Flat } }
box { <0, -3, -1>, <4, 0, -0.5> pigment { gradient y color_map { [0, 0.5 color Sand color 0.5*Sky] [0.5, 1.01 color Sky color rgb 0] } scale 2 } finish { Flat } }
box { <-4, 1, -1>, <4, 3, -0.5> pigment { gradient x color_map { [0 Sand.red*Sky] [.1*2 .3*Sand + .1] [1 .3*<1, 2, 3, 0, 0>] } scale 8 translate -4*x } finish { Flat } }
