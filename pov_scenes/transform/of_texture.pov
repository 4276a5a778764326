// A texture written before a transform goes with the object, one written after it stays.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { -0.7, 0.7 pigment { checker rgb <0.9, 0.9, 0.6>, rgb <0.6, 0.1, 0.1> scale 0.35 } rotate <20, 30, 0> translate -1.2*x }
box { -0.7, 0.7 rotate <20, 30, 0> translate 1.2*x pigment { checker rgb <0.9, 0.9, 0.6>, rgb <0.1, 0.1, 0.6> scale 0.35 } }
