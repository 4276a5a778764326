// Of two coincident faces the one shows whose points the other part lets through. A cylinder's ends are outside of it, the
// surface of a plane or blob inside: a cut by a flush cylinder or plane shows the first cylinder, one by a blob the second.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 5, -9> look_at 0 angle 40 }
light_source { <4, 8, -6>, 1 }
background { rgb <.2, .3, .5> }
#declare Red = pigment { rgb <1, .3, .2> }
#declare Green = pigment { rgb <.3, .8, .4> }
difference { cylinder { -y, y, 1 pigment { Red } } cylinder { -y, y, .6 pigment { Green } } translate <-2.6, 0, 1> }
difference { cylinder { -y, y, 1 pigment { Red } } plane { y, 1 pigment { Green } } translate z }
#declare Blob = blob { threshold .5 sphere { <-.3, 0, 0>, 1.2, 1 } sphere { <.5, 0, .2>, 1, 1 } }
difference { object { Blob pigment { Red } } object { Blob pigment { Green } } translate <2.6, 0, 1> }
difference { cone { -y, 1, y, .6 pigment { Red } } cylinder { -.5*y, y, .4 pigment { Green } } translate <-1.4, 0, -2.4> }
difference {
  plane { y, .4 pigment { Red } } plane { y, .4 pigment { Green } }
  clipped_by { sphere { .4*y, .9 } } translate <1.4, 0, -2.4>
}
