// Functions of the pattern `object`: 1 or the second entry inside, in patterns, pigments and `pigment_pattern`, for formulas that colour, tilt and shape.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -9> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Cross = union { cylinder { -2*y, 2*y, 0.3 } cylinder { -2*x, 2*x, 0.2 } light_source { <9, 9, -9>, rgb 0.2 } }
#declare Inside = function { pattern { object { Cross } rotate 20*z } }
#declare Moved = function { pattern { object { sphere { 0, 0.5 } scale <1.5, 1, 1> } warp { repeat 1.2*y } turbulence 0.1 } }
#declare Colors = function { pigment { object { Cross rotate 45*z rgb <1, 0.2, 0>, rgb <0, 0.5, 1> } } }
#declare Pigments = function { pigment { object { box { <-0.6, -2, -2>, <0.6, 2, 2> } pigment { rgb 0 } pigment { checker rgb 1 rgb 0.3 scale 0.2 } } scale 0.8 } }
#declare Shared = pigment { object { Cross rgb 0.2 rgb 1 } }
#declare Grey = function { pattern { pigment_pattern { Shared } translate 0.2*x } }
box { -0.8, 0.8 pigment { function { Inside(x, y, z) } color_map { [0 rgb 1] [1 rgb <0.9, 0.2, 0.2>] } } rotate <20, 30, 0> translate <-2.2, 1.2, 0> }
box { -0.8, 0.8 pigment { function { 0.5 * Colors(x, y, z).blue + 0.3 * Moved(x, y, z) } } rotate <20, 30, 0> translate <0, 1.2, 0> }
box { -0.8, 0.8 pigment { function { Pigments(x, y, z).gray } } rotate <20, 30, 0> translate <2.2, 1.2, 0> }
box { -0.8, 0.8 pigment { Shared } rotate <20, 30, 0> translate <-2.2, -1.2, 0> }
box { -0.8, 0.8 pigment { function { Grey(x, y, z) } color_map { [0 rgb <0.2, 0.4, 0.2>] [1 rgb <0.9, 0.9, 0.3>] } } rotate <20, 30, 0> translate <0, -1.2, 0> }
height_field { function 50, 50 { 0.3 * Moved(2 * (x - 0.5), 2 * (y - 0.5), 0) + 0.1 * Inside(x - 0.5, y - 0.5, 0) } smooth translate -0.5 scale <1.7, 1, 1.7> rotate -60*x translate <2.2, -1.2, 0> pigment { rgb <0.6, 0.8, 0.9> } }
