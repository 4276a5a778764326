// Coincident faces that hide each other leave a hole: the ends of a cylinder are outside of it, so those that two cylinders
// share are open in their intersection; the surface of a blob is inside, so a second equal cut removes the surface of the first.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1.5, 5, -9> look_at .4*x angle 44 }
light_source { <4, 8, -6>, 1 }
background { rgb <.2, .3, .5> }
#declare Blob = blob { threshold .5 sphere { <-.3, 0, 0>, 1.2, 1 } sphere { <.5, 0, .2>, 1, 1 } }
union {
  intersection { cylinder { -y, y, 1 } cylinder { -y, y, .8 } rotate <-20, 0, 15> translate -2.4*x }
  difference { box { -1, 1 } object { Blob translate .8*y } object { Blob translate .8*y } }
  merge { object { Blob translate 2.6*x } object { Blob translate 2.6*x } }
  merge { cylinder { -y, y, .8 translate 2.8*x } cylinder { -y, y, .5 translate 3.3*x } }
  pigment { rgb <1, .5, .2> }
}
