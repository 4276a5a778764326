// The default map of `mandel` is coloured for exponent 2 and grey for higher ones; a map of the scene holds for all.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -9> look_at 0 right 8*x up 6*y }
#declare Flat = finish { ambient 1 diffuse 0 }
plane { z, 0 pigment { mandel 33 exponent 3 scale 1.2 } finish { Flat } }
box { <-4, -3, -1>, <-1, 0, -0.5> pigment { mandel 33 exponent 2 translate <-2, -1.5, 0> } finish { Flat } }
box { <-1, -3, -1>, <2, 0, -0.5> pigment { mandel 25 exponent 4 frequency 2 translate <0.5, -1.5, 0> } finish { Flat } }
box { <2, -3, -1>, <4, 0, -0.5> pigment { mandel 25 exterior 2, 3 exponent 5 translate <3, -1.5, 0> } finish { Flat } }
box { <-4, 1, -1>, <-1, 3, -0.5> pigment { mandel 20 color_map { [0 rgb x] [0.3 rgb y] [1 rgb z] } exponent 6 translate <-2.5, 2, 0> } finish { Flat } }
