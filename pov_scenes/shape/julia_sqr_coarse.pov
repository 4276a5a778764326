// The square of hypercomplex numbers at a low precision: the search begins on the bounding sphere, where the last bit
// decides if a point is inside, and so where all steps after it end.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> right x*4/3 angle 30 }
background { rgb 0.5 }
julia_fractal {
  <0.2, 0.1, 0.59, -0.2>
  max_iteration 7 precision 20 sqr hypercomplex
  pigment { rgb <0.8, 0.65, 0.85> }
  finish { ambient 1 diffuse 0 }
}
