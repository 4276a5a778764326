// Crackle that repeats after two cells along x and three along y.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location -5*z right 8*x up 6*y }
light_source { <5, 8, -6>, 0.8 }
plane { z, 0 pigment { crackle repeat <2, 3, 0> color_map { [0 rgb 1] [0.5 rgb <1, 0.6, 0.1>] [1 rgb <0.6, 0, 0.2>] } } }
