// Before version 1.5 operators stand only within parentheses and colours: `<1 -1 0>` has three components.
#version 1.0
#declare Side = 2
#declare Red = color red 1 green 0.2
camera { location <0 1 -8> direction <0 0 1.5> look_at <0 0 0> }
object { light_source { <-4 6 -8> color red 1 green 1 blue 1 } }
sphere { <-1.5 -1 0> 1 pigment { color Red * 0.8 } }
sphere { (<Side -1 1>) abs(Side -1.2) pigment { color rgb <0.2 0.9 0.3> * 0.9 } }
box { <-1 -Side -1> <(1 -0.3) -1.2 +1> pigment { color rgb <0.3 0.4 1> } }
#if (Side -2)
  sphere { <0 0 0> 5 }
#end
cylinder { <1 -1.5 -1> <(vlength(<3 4 0>) * 0.4) -1 0> 0.3 pigment { color blue 1 green (1 -0.3) } translate <-0.5 +2 -1> }
