// height_field of a function: 16 bits of its values, the first row at z = 1.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.5, 1.4, -1.5> look_at <0.5, 0.1, 0.5> angle 45 }
light_source { <-3, 8, -5>, 1 }
#declare Hills = function(x, y) { 0.3 + 0.2*sin(9*x)*cos(7*y) + 0.1*x }
height_field { function 40, 30 { Hills(x, y) } pigment { rgb <0.6, 0.8, 0.5> } }
height_field { function 40, 30 { pattern { bozo scale 0.2 } } smooth water_level 0.4 translate <-1.1, 0, 0> pigment { rgb <0.8, 0.7, 0.5> } }
height_field { function 20, 20 { pigment { wood scale 0.3 color_map { [0 rgb 0] [1 rgb <0.5, 0.2, 0.9>] } } } scale <1, 0.5, 1> translate <1.1, 0, 0> pigment { rgb <0.5, 0.7, 0.9> } }
