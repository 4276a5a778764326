// Open cylinders and cones among the many parts of a merge and of a difference show their inner walls.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 5, -10> look_at <0, 0.6, 0> angle 32 }
background { rgb <0.5, 0.5, 0.8> }
light_source { <500, 500, -500>, rgb 1 }
#declare Pearls = union {
  sphere { <-1.6, 1, 0>, 0.15 }
  sphere { <1.6, 1, 0>, 0.15 }
  sphere { <0, 2.2, 0>, 0.15 }
}
merge {
  cylinder { 0, 1.4*y, 1 open }
  sphere { <-1.3, 0.2, 0>, 0.2 }
  sphere { <1.3, 0.2, 0>, 0.2 }
  sphere { <0, 2, 0>, 0.2 }
  torus { 1, 0.1 translate 0.7*y }
  translate -1.5*x
  pigment { rgb <1, 1, 0> }
}
merge {
  cone { 0, 0.4, 1.4*y, 1 open }
  Pearls
  sphere { <0, 0, -1.2>, 0.2 }
  translate 1.5*x
  pigment { rgb <0.3, 0.9, 0.5> }
}
difference {
  box { <-1, -1, -0.4>, <1, -0.2, 0.4> }
  cylinder { <-0.6, -2, 0>, <-0.6, 2, 0>, 0.3 open }
  cone { <0.1, -2, 0>, 0.3, <0.1, 2, 0>, 0.2 open }
  sphere { <0.7, -0.2, 0>, 0.2 }
  sphere { <0.7, -0.2, -0.4>, 0.2 }
  translate -2.6*z
  pigment { rgb <0.9, 0.4, 0.3> }
}
