// A macro that takes a mixed array and a dictionary and returns a colour.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare Ball = dictionary { .Radius: 0.8, .At: <-1.2, 0, 0>, .Tint: <0.9, 0.4, 0.2> };
#declare Sizes = array mixed[3] { 0.7, <1.2, 0, 0>, rgb <0.2, 0.6, 0.9> };
#macro Shown(What, Parts) sphere { What.At, What.Radius pigment { rgb What.Tint } } sphere { Parts[1], Parts[0] pigment { color Parts[2] } } #end
Shown(Ball, Sizes)
