// Crackle of another metric, form and offset that repeats.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { y, -1 pigment { crackle metric 1 form <-1, 0.5, 0.4> offset 0.1 repeat <3, 0, 2> color_map { [0 rgb 1] [0.5 rgb <1, 0.6, 0.1>] [1 rgb <0.6, 0, 0.2>] } } }
