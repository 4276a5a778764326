// An object is seen by rays that meet its box alone, and what clips it brings its own box: that of a height field or a
// disc holds far less than the inside. Red: clipped shapes. Green: what moves them, and parts of unions, which lose the
// box where the union is moved. Blue: combinations. White: inverse clips and larger boxes cut nothing.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 2, -20> right 16*x up 12*y look_at 0 }
light_source { <50, 90, -90> 1 }
#declare Hills = height_field { function 20, 20 { .4 + .1*sin(x*9)*cos(y*9) } smooth translate <-.5, 0, -.5> scale <2, 1.5, 2> }
#declare Disc = disc { 0, y, .8 }
#declare Post = cylinder { -2*y, 2*y, .6 }
#declare Cut = object { Post clipped_by { Hills } }
#declare Dot = sphere { <.9, -.8, 0>, .1 }
#declare Hyperboloid = quadric { <1, -.5, 1>, 0, 0, -.06 }

object { Post clipped_by { Hills } pigment { rgb x } translate <-7, 3.5, 0> }
union { object { Post } sphere { 0, .7 } clipped_by { Hills } pigment { rgb x } translate <-5, 3.5, 0> }
object { Hyperboloid clipped_by { Hills } pigment { rgb x } translate <-3, 3.5, 0> }
plane { z, 0 clipped_by { Hills } pigment { rgb x } translate <-1, 3.5, 0> }
object { Post clipped_by { object { Hills } object { Hills translate .4*x } } pigment { rgb x } translate <1, 3.5, 0> }
object { Post clipped_by { object { Disc rotate 60*x } } pigment { rgb x } translate <3, 3.5, 0> }
object { Post clipped_by { union { object { Hills } sphere { -y, .3 } } } pigment { rgb x } translate <5, 3.5, 0> }
object { Post clipped_by { Hills } bounded_by { box { <-1, -1.5, -1>, 1 } } pigment { rgb x } translate <7, 3.5, 0> }

object { Cut rotate 30*z pigment { rgb y } translate -7*x }
union { object { Cut translate -5*x } object { Dot translate -5*x } pigment { rgb y } }
union { object { Cut } object { Dot } pigment { rgb y } translate -3*x }
union { union { object { Cut translate -x } object { Dot translate -x } } pigment { rgb y } }
merge { object { Cut } object { Dot } pigment { rgb y } translate 1*x }
object { Hyperboloid clipped_by { Hills } rotate 30*z pigment { rgb y } translate 3*x }
object { Post clipped_by { object { Cut scale 1.1 } } pigment { rgb y } translate 5*x }
plane { z, 0 clipped_by { Cut } rotate 20*x pigment { rgb y } translate 7*x }

intersection { object { Cut } box { <-1, -1.5, -1>, 1 } pigment { rgb z } translate <-7, -3.5, 0> }
difference { object { Cut } box { <-1, -1.5, -1>, <0, 0, 1> } pigment { rgb z } translate <-5, -3.5, 0> }
intersection { object { Post } object { Hills } pigment { rgb z } translate <-3, -3.5, 0> }
intersection { sphere { 0, .7 } disc { 0, y, .6 } pigment { rgb z } translate <-1, -3.5, 0> }
difference { sphere { 0, .7 } disc { 0, y, .6 } pigment { rgb 1 } translate <1, -3.5, 0> }
object { Post clipped_by { object { Hills inverse } } pigment { rgb 1 } translate <3, -3.5, 0> }
cylinder { -2*y, 2*y, .1 clipped_by { Hills } pigment { rgb 1 } translate <5, -3.5, 0> }
sphere { 0, .6 clipped_by { quadric { <-1, -1, -1>, 0, 0, .04 } } pigment { rgb 1 } translate <7, -3.5, 0> }
