// slope and aoi in a map of textures: the lower entry is chosen by the normal that the bumps of the upper one have made.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -9> look_at <0, 0, 0> angle 45 }
light_source { <-20, 30, -30>, 1 }
#declare Bumpy = texture { pigment { rgb <1, 0.8, 0.6> } normal { bumps 0.5 scale 0.1 } }
#declare BySlope = texture { slope { y } texture_map { [0.6 pigment { rgb x }] [0.6 pigment { rgb y }] } }
#declare ByAngle = texture { aoi texture_map { [0.75 pigment { rgb z }] [0.75 pigment { rgb <1, 1, 0> }] } }
#macro Blend(A, B)
  texture { gradient x scale 2.4 translate -1.2*x texture_map { [0 A] [1 B] } }
#end
sphere { 0, 1 Blend(BySlope, Bumpy) translate <-2.2, 1.1, 0> }
sphere { 0, 1 Blend(Bumpy, BySlope) translate <0, 1.1, 0> }
sphere { 0, 1 Blend(ByAngle, Bumpy) translate <2.2, 1.1, 0> }
sphere { 0, 1 texture { average texture_map { [1 Bumpy] [1 pigment { rgb 0.5 }] [1 BySlope] } } translate <-2.2, -1.1, 0> }
sphere { 0, 1 texture { average texture_map { [1 BySlope] [1 Bumpy] } } translate <0, -1.1, 0> }
box { -0.8, 0.8 texture { average texture_map { [1 pigment { rgb 1 } normal { wood 0.6 scale 0.3 }] [1 BySlope] } } rotate <20, 40, 0> translate <2.2, -1.1, 0> }
