// A declared pigment changed where it is used.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare P = pigment { gradient x turbulence 0.1 color_map { [0 rgb z] [0.5 rgb y] [1 rgb x] } }
plane { -z, -1 pigment { P scale 0.5 turbulence 0.4 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { P frequency 3 color_map { [0 rgb 1] [1 rgb x] } } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { P octaves 1 rotate 90*z } }
