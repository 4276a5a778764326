// Merges of boxes upon prisms, turned by quarters and scaled by halves: roundings of points leave one surface nearly all over.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <14, 14, -18> look_at <0, 3, 0> angle 34 }
light_source { <20, 30, -20>, 1 }
background { rgb <0.4, 0.6, 0.9> }
plane { y, -4 pigment { checker rgb 1, rgb 0.6 } }
#declare Clear = pigment { rgbt <0.2, 0.2, 1, 0.5> }
#declare Post = merge {
  prism { 0, 5, 5, <-1, -1>, <-1, 1>, <1, 1>, <1, -1>, <-1, -1> }
  box { <-1, 0, -1>, <1, 1, 1> translate 5*y }
}
object { Post pigment { Clear } }
object { Post scale 0.5 rotate 90*x translate <0, 2, 1> pigment { Clear } }
object { Post scale 0.5 rotate -90*x translate <0, 2, -1> pigment { Clear } }
object { Post scale 0.5 rotate 90*z translate <-1, 2, 0> pigment { Clear } }
object { Post scale 0.5 rotate -90*z translate <1, 2, 0> pigment { Clear } }
object { Post scale 0.25 rotate -90*z rotate 90*y translate <2.5, 2, -0.5> pigment { Clear } }
object { Post scale 0.25 rotate 180*x translate <2.5, 1.5, 0> pigment { Clear } }
