// The octave weights of `f_ridged_mf` are those of its first call in the picture, here of the plane behind the ball.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Ridged = function { internal(59) }
#declare Behind = function { Ridged(x, y, z, 0.07, 2.2, 7, 0.6, 0.9, 1) }
#declare Before = function { Ridged(x, y, z, 0.9, 3.1, 8, 0.7, 0.8, 2) }
camera { location -5*z look_at 0 }
light_source { <3, 5, -5>, 1 }
plane { -z, -2 pigment { function { Behind(x, y, z)*0.4 } color_map { [0 rgb 0] [1 rgb 1] } } }
sphere { 0, 1 pigment { function { Before(x, y, z)*0.4 } color_map { [0 rgb 0] [1 rgb 1] } } }
