// With one iteration or none nothing is seen of a fractal; a precision below one is one.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 1.2, -4> look_at 0 angle 50 }
light_source { <3, 5, -6> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
#declare C = <-0.083, 0, -0.83, -0.025>;
#declare Finish = texture { pigment { rgb <1, 0.7, 0.3> } }
julia_fractal { C quaternion sqr max_iteration 1 texture { Finish } scale 0.5 translate -x }
julia_fractal { C quaternion sqr max_iteration -3 texture { Finish } scale 0.5 translate -x }
julia_fractal { C quaternion sqr max_iteration 8 precision 0.5 texture { Finish } scale 0.6 }
julia_fractal { C quaternion sqr max_iteration 8 precision -20 texture { Finish } scale 0.6 translate 1.2*x }
