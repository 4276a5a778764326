// A shape shows to rays that hit the box of its bounds alone, where this is smaller than its own; the bounds themselves are
// not tested. Blobs, height fields and Julia fractals keep their boxes, flat shapes too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 2, -20> right 16*x up 12*y look_at 0 }
light_source { <50, 90, -90> 1 }
#declare Small = sphere { <0.3, 0.2, 0>, 0.5 }
#default { pigment { rgb <1, 0.4, 0.2> } }

cylinder { -y, y, 1 bounded_by { Small } translate <-7, 3.5, 0> }
cone { -y, 1, y, 0.3 bounded_by { Small } rotate 20*z translate <-4, 3.5, 0> }
torus { 0.8, 0.3 rotate 60*x bounded_by { Small } translate <-1, 3.5, 0> }
superellipsoid { <0.5, 0.5> bounded_by { Small } translate <2, 3.5, 0> }
prism { -0.5, 0.5, 5, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1> rotate 80*x bounded_by { Small } translate <5, 3.5, 0> }

quadric { <1, 1, 0>, 0, 0, -0.6 bounded_by { Small } translate <-7, 0, 0> }
isosurface { function { x*x + y*y + z*z - 0.8 } max_gradient 3 contained_by { box { -1, 1 } } bounded_by { Small }
  translate <-4, 0, 0> }
lathe { linear_spline 4, <0.1, -1>, <0.8, -0.8>, <0.5, 0.2>, <0.9, 1> bounded_by { Small } translate <-1, 0, 0> }
plane { z, 0 bounded_by { Small } rotate 10*y translate <2, 0, 0> }
union { cone { -y, 1, y, 0.2 bounded_by { Small } } cylinder { -y, y, 0.5 } translate <5, 0, 0> }

blob { threshold 0.5 sphere { 0, 1, 1 } sphere { 0.4, 0.6, 1 } bounded_by { Small } translate <-7, -3.5, 0> }
height_field { function 9, 9 { x*y } translate -0.5 scale 2 bounded_by { Small } translate <-4, -3.5, 0> }
julia_fractal { <-0.08, 0, -0.83, -0.025> quaternion sqr max_iteration 6 precision 20 bounded_by { Small }
  translate <-1, -3.5, 0> }
mesh { triangle { <-1, -1, 0>, <1, -1, 0>, <0, 1, 0> } bounded_by { Small } translate <2, -3.5, 0> }
