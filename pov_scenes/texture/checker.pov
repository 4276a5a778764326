// A checker fills space with two colours in unit cubes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-1.2, -0.9, -0.7>, <1.1, 0.8, 0.9> rotate <15, 35, 0> pigment { checker rgb <0.9, 0.8, 0.3>, rgb <0.5, 0.1, 0.3> scale 0.45 } }
