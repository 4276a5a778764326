// A Julia fractal of cubes of quaternions.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
julia_fractal {
  <-0.45, 0.3, 0.55, 0.1>
  cube max_iteration 7 precision 30
  pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 }
 rotate 30*x }
