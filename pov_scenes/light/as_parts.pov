// Lights are parts of combinations by their bare names too; intersections and differences pass them over.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -9> look_at 0 angle 40 }
#declare Warm = light_source { <-4, 6, -8>, rgb <0.9, 0.7, 0.4> }
#declare Lights = array[2] { light_source { <6, 2, -6>, rgb <0.2, 0.3, 0.6> }, light_source { <0, -5, -4>, rgb <0.1, 0.3, 0.1> } }
plane { y, -1.5 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union { sphere { -2.2*x, 0.8 pigment { rgb 1 } } Warm }
intersection { sphere { 0, 0.9 } box { -0.7, 0.7 } Lights[0] pigment { rgb 1 } rotate <20, 30, 0> }
difference { box { -0.7, 0.7 } light_source { <3, 5, -4>, rgb 0.3 } sphere { -0.6*z, 0.6 } Lights[1] pigment { rgb 1 } rotate <20, -30, 0> translate 2.2*x }
