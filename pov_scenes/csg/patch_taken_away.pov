// A patch cannot be inverted: what takes one away shows only the patch, where it lies in the rest.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -9> look_at 0 angle 45 }
light_source { <5, 9, -9>, rgb 1 }
#declare Red = texture { pigment { rgb <1, 0.2, 0.1> } }
#declare Green = texture { pigment { rgb <0.2, 0.9, 0.3> } }
#declare Sheet = triangle { <-2, -2, 0.2>, <2, -2, 0.2>, <0, 2, 0.2> }
#declare Face = mesh { triangle { <-2, -2, 0.2>, <2, -2, 0.2>, <0, 2, 0.2> } }
#declare Square = polygon { 5, <-2, -2>, <2, -2>, <2, 2>, <-2, 2>, <-2, -2> }
#declare Mixed = union { object { Sheet } sphere { <0.4, 1.2, 0>, 0.8 } }
difference { sphere { 0, 1 texture { Red } } object { Sheet texture { Green } } translate <-2.6, 1.2, 0> }
intersection { sphere { 0, 1 texture { Red } } object { Face inverse texture { Green } } translate <0, 1.2, 0> }
difference { box { -0.8, 0.8 texture { Red } } object { Square texture { Green } } rotate 20 * y translate <2.6, 1.2, 0> }
difference { sphere { 0, 1 texture { Red } } object { Mixed texture { Green } } translate <-2.6, -1.4, 0> }
intersection { sphere { 0, 1 texture { Red } } object { Mixed inverse texture { Green } } translate <0, -1.4, 0> }
difference {
  box { -0.9, 0.9 texture { Red } }
  difference { sphere { 0, 1.1 } object { Sheet } texture { Green } }
  rotate -20 * y translate <2.6, -1.4, 0>
}
