// A Julia fractal of hypercomplex numbers, squared.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
julia_fractal {
  <-0.1, 0.4, -0.2, 0.3>
  hypercomplex sqr max_iteration 8 precision 40
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
}
