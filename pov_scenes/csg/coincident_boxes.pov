// Coincident faces of boxes: rounding puts those at z = 0.3 inside the boxes and those at z = 0.6 outside, all over a face. A
// merge has a hole or shows the last face, a difference has the last texture or the first, an intersection a face or a hole.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -10> look_at 0 angle 50 }
background { rgb 0.2 }
#default { finish { ambient 1 diffuse 0 } }
#macro Pair(Z)
  box { <-1, -1, Z>, <1, 1, Z + 1> pigment { gradient z color_map { [0 rgb <0.5, 0, 0>] [1 rgb <1, 0.5, 0>] } scale 3 } }
  box { <-0.7, -0.7, Z>, <0.7, 0.7, Z + 0.5> pigment { gradient z color_map { [0 rgb <0, 0.5, 0.2>] [1 rgb <0, 1, 1>] } scale 3 } }
#end
merge { Pair(0.3) translate -2.5*x }
difference { Pair(0.3) }
intersection { Pair(0.3) translate 2.5*x }
merge { Pair(0.6) translate <-2.5, 2.5, 0> }
difference { Pair(0.6) translate 2.5*y }
intersection { Pair(0.6) translate <2.5, 2.5, 0> }
merge { Pair(0.1) translate <-2.5, -2.5, 0.2> }
difference { Pair(0.1) translate <0, -2.5, 0.2> }
intersection { Pair(0.1) translate <2.5, -2.5, 0.2> }
