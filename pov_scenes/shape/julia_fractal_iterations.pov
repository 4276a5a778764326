// A Julia fractal of many iterations: its shadows on itself and its mirror images depend on the last digit of each hit.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <-2, 1.5, 1.5> look_at 0 angle 60 right x*4/3 }
background { rgb 1 }
light_source { <5, 3, 3>, 1 }
julia_fractal {
  <-0.08, 0, -0.83, -0.025> quaternion sqr max_iteration 40 precision 100 slice <0, 0, 0, 1>, 0.1
  pigment { rgb <1, 0.8, 0.6> }
  finish { reflection 0.4 }
}
