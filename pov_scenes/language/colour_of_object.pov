// A colour of an object itself has no effect, as a word or as a name.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
#declare Red = rgb x;
#declare Colors = array[1] { rgb y }

sphere { -1.5*x, 0.7 Red pigment { rgb z } }
box { -0.5, 0.5 pigment { rgb 1 } Colors[0] rotate 30 }
union { sphere { 1.5*x, 0.7 } sphere { 1.5*x + y, 0.4 } Red color rgb 1 pigment { rgb <1, 1, 0> } }
