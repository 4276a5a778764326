// A Julia fractal of the function sinh, whose normals follow iterates that the search left behind.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.5, 1, -6> look_at 0 angle 30 }
light_source { <3, 6, -7>, 1 shadowless }
background { rgb <0.1, 0.2, 0.3> }
julia_fractal { <-0.3, -0.25, -0.2, -0.4> hypercomplex sinh max_iteration 5 precision 20 pigment { rgb <0.9, 0.6, 0.3> } }
