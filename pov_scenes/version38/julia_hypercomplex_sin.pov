// A Julia fractal of the sine of hypercomplex numbers: one inside test for search and halving.
// size: 80x60
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
julia_fractal { <-0.5, 0.3, 0, 0.1> hypercomplex sin max_iteration 4 precision 20 pigment { rgb <1, 0.7, 0.3> } }
