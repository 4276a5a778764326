// Radiosity before an open sky: a pass of the pretrace leaves out the blocks in which the one before asked for no light.
#version 3.7;
global_settings {
  assumed_gamma 1
  radiosity { pretrace_start 0.08 pretrace_end 0.02 count 50 nearest_count 4 error_bound 0.7 recursion_limit 1 minimum_reuse 0.01 }
}
camera { location <0, 1.5, -5> look_at 0.7*y angle 50 }
background { rgb <0.6, 0.7, 0.9> }
plane { y, 0 pigment { rgb 0.7 } }
sphere { <0.8, 0.6, -0.2>, 0.6 pigment { rgb y } }
box { <-1.4, 0, 0>, <-0.3, 1.1, 0.9> pigment { rgb x } rotate 10*y }
