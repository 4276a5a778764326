// min_extent and max_extent of what is clipped: what all clips share counts where its box is the smaller one, inverse clips
// do not, and quadrics know what planes and boxes leave of them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 3, -20> right 16*x up 12*y look_at 0 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Number = 0;
#macro Show(Thing)
  object {
    box { min_extent(Thing), max_extent(Thing) }
    pigment { rgb <.4 + .5*mod(Number, 2), .6, .9 - .1*mod(Number, 7)> }
    translate <2*mod(Number, 8) - 7, 4 - 2.6*div(Number, 8), 0>
  }
  #declare Number = Number + 1;
#end
#declare Hills = height_field { function 20, 20 { .4 + .1*sin(x*9)*cos(y*9) } smooth translate <-.5, 0, -.5> scale <2, 1.5, 2> }
#declare Ball = sphere { 0, .5 }
#declare Left = object { Ball translate -.3*x }
#declare Right = object { Ball translate .3*x }
#declare Post = cylinder { -y, y, .6 }
#declare Rod = quadric { <1, 0, 1>, 0, 0, -.04 }
#declare Cut = object { Post clipped_by { Ball } }
#declare A = object { Post clipped_by { object { Left } object { Right } } } Show(A)
#declare A = object { Post clipped_by { Left } clipped_by { Right } } Show(A)
#declare A = object { Post clipped_by { object { Left inverse } object { Right } } } Show(A)
#declare A = object { Post clipped_by { object { Ball inverse } } } Show(A)
#declare A = object { Post clipped_by { plane { y, .1 } object { Left } } } Show(A)
#declare A = object { Post clipped_by { Left } rotate 45*z clipped_by { object { Ball scale <.8, 1, 1> } } } Show(A)
#declare A = union { object { Post } bounded_by { object { Left } object { Right } } } Show(A)
#declare A = union { object { Post } clipped_by { Left } bounded_by { object { Right scale .9 } } } Show(A)
#declare A = object { Post clipped_by { Hills } } Show(A)
#declare A = intersection { object { Post } object { Hills } } Show(A)
#declare A = intersection { object { Post } union { object { Hills } } } Show(A)
#declare A = difference { object { Hills } object { Ball } } #declare A = intersection { object { A } box { -.7, .7 } } Show(A)
#declare A = plane { z, 0 clipped_by { Cut } } Show(A)
#declare A = plane { z, 0 clipped_by { Cut } translate .5*y } Show(A)
#declare A = plane { z, 0 clipped_by { object { Cut translate .5*y } } } Show(A)
#declare A = plane { z, 0 clipped_by { union { object { Post } clipped_by { Ball } } } rotate 45*z } Show(A)
#declare A = object { Rod clipped_by { Ball } } Show(A)
#declare A = object { Rod clipped_by { plane { y, .7 } plane { y, -.3 inverse } } } Show(A)
#declare A = object { Rod clipped_by { Ball } rotate 45*z } Show(A)
#declare A = object { Rod rotate 45*z clipped_by { Ball } } Show(A)
#declare A = object { Rod translate .2*x clipped_by { Ball } translate .3*y } Show(A)
#declare A = object { Rod clipped_by { Ball } translate .2*x clipped_by { object { Ball translate .3*y } } } Show(A)
#declare A = plane { z, 0 clipped_by { object { Rod clipped_by { Ball } } } rotate 45*z } Show(A)
#declare A = quadric { <1, 1, 1>, 0, 0, -.4 clipped_by { plane { y, .1 } } } Show(A)
#declare A = quadric { <-1, 0, -1>, 0, 0, .04 clipped_by { Ball } } Show(A)
#declare A = quadric { <1, 0, 1>, 0, <0, -1, 0>, 0 clipped_by { Ball } } Show(A)
#declare A = quadric { <1, -1, 1>, 0, 0, -.04 clipped_by { Ball } } Show(A)
#declare A = object { Rod inverse clipped_by { Ball } } Show(A)
