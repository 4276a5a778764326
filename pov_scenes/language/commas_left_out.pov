// Strings of concat and pairs of numbers in global settings need no comma.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
global_settings { photons { count 100 media 10 2 radius 0.1 1.5 } }
#declare Name = concat("a" "b" concat("c", "d") "e");

sphere { -x, strlen(Name)/5 pigment { rgb 1 } }
sphere { x, 0.7 pigment { rgb <1, 0.7, 0.3> } }
