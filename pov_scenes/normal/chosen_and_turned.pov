// Bumps of textures that a pattern chooses turn with the pattern, and with the object.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -9> look_at 0 angle 40 }
light_source { <3, 8, -4> rgb 1 }
#declare Rough = texture { pigment { rgb 1 } normal { bumps 1 scale <0.3, 0.6, 0.3> rotate 30 } }
#declare Smooth = texture { pigment { rgb <1, 0.6, 0.3> } }
sphere { <-2, 1, 0>, 0.9 texture { gradient y texture_map { [0 Rough] [1 Smooth] } rotate 40 } }
sphere { <0, 1, 0>, 0.9 texture { bozo texture_map { [0 Rough] [1 Rough] } scale <1, 2, 0.5> } }
sphere { 0, 0.9 texture { gradient y turbulence 0.3 texture_map { [0 Rough] [1 Smooth] } } rotate 40 scale <1, 0.8, 1> translate <2, 1, 0> }
sphere { <-2, -1, 0>, 0.9 texture { average texture_map { [1 Rough] [2 Smooth] } rotate z * 70 } }
sphere { <0, -1, 0>, 0.9 texture { checker texture { Rough } texture { Smooth } rotate 25 scale 0.4 } }
sphere { <2, -1, 0>, 0.9 texture { gradient x texture_map { [0 wood texture_map { [0 Rough] [1 Smooth] } rotate 50 ] [1 Rough] } rotate 20 } }
