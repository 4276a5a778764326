// A Julia fractal of cubes of hypercomplex numbers.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -3> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
julia_fractal { <-0.1, 0.3, -0.5, -0.025> hypercomplex cube max_iteration 6 precision 40 pigment { rgb <1, 0.7, 0.3> } }
