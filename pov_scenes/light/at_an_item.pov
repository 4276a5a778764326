// A light stands at an item of an array of vectors, alone or in an expression; an item that is a light is that light.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
#declare Places = array[2] { <-4, 6, -8>, <4, 1, -3> }
#declare Deep = array[2][2] { { x, y }, { z, <0, 1, 0> } }
#declare Numbers = array[1] { 7 }
#declare Lights = array[1] { light_source { <-6, 0, -6>, rgb <0, 0.2, 0.4> } }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { rgb 1 } }
light_source { Places[0] rgb 0.4 }
light_source { Places[1] * 2 - y, rgb <0.4, 0.1, 0.1> }
light_source { Numbers[0] * Deep[1][1] rgb <0, 0.3, 0> spotlight point_at Places[1] - Places[1] radius 6 falloff 9 }
union { light_source { Places[1].x * x + 3 * y rgb <0.2, 0.2, 0> } sphere { <1.2, -0.6, -0.6>, 0.3 pigment { rgb 1 } } rotate -20*y }
light_source { Lights[0] translate y }
