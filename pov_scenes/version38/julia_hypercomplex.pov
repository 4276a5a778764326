// A Julia fractal of hypercomplex numbers.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -3> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
julia_fractal { <-0.083, 0, -0.83, -0.025> hypercomplex sqr max_iteration 8 precision 40 pigment { rgb <1, 0.7, 0.3> } }
