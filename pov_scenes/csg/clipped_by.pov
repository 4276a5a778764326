// Clipping takes surface away and leaves no caps.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 clipped_by { plane { <0.2, 1, -0.6>, 0.2 } } translate -1.1*x pigment { rgb <0.9, 0.5, 0.3> } }
box { -0.8, 0.8 clipped_by { sphere { 0, 1 } } rotate <20, 30, 0> translate 1.1*x pigment { rgb <0.3, 0.6, 0.9> } }
