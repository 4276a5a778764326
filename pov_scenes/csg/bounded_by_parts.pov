// A bound that holds a part of a combination only in part hides its surface beside it, and the part cuts all the same; even
// a primitive keeps its bound there. The camera is inside of the last bound, which no ray meets.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 2, -9> look_at <0, -0.1, 0> angle 50 }
light_source { <5, 8, -6>, rgb 1 }
background { rgb 0.2 }
#declare Left = box { <-2, -2, -2>, <0, 2, 2> }
#declare Right = box { <0.5, -2, -2>, <2, 2, 2> }
union {
  intersection {
    sphere { 0, 1 bounded_by { Left } }
    box { <-2, -0.5, -2>, <2, 0.7, 2> }
    pigment { rgb <1, 0.5, 0.2> }
    translate <-2.2, 1.1, 0>
  }
  difference {
    box { -0.9, 0.9 }
    difference { sphere { <0.5, 1, -1>, 0.9 } sphere { <0.5, 1, -1>, 0.3 } bounded_by { Right } }
    pigment { rgb <0.3, 0.8, 0.5> }
    translate <0, 1.1, 0>
  }
  merge {
    sphere { 0, 1 bounded_by { Left } }
    box { <-1.1, -0.5, -1.1>, <1.1, -0.4, 1.1> }
    pigment { rgb <0.4, 0.6, 1> }
    translate <2.3, 1.1, 0>
  }
  difference {
    box { -0.9, 0.9 bounded_by { sphere { 0, 1.1 } } }
    sphere { <0.5, 1, -1>, 0.9 }
    pigment { rgb <0.9, 0.9, 0.4> }
    translate <-2.2, -1.3, 0>
  }
  union {
    sphere { 0, 0.9 bounded_by { Left } }
    box { <-1.2, -0.1, -1.2>, <1.2, 0.1, 1.2> }
    clipped_by { sphere { 0, 1.3 } }
    pigment { rgb <0.8, 0.4, 0.8> }
    translate <0, -1.3, 0>
  }
  difference {
    sphere { 0, 1 }
    box { <-0.3, -2, -2>, <0.3, 2, 2> }
    bounded_by { plane { -z, 10 } }
    pigment { rgb <0.5, 0.9, 0.9> }
    translate <2.3, -1.3, 0>
  }
}
