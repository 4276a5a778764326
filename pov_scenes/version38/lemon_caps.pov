// The caps of a lemon, of different radii, and its cut.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
difference { lemon { <-1, -1, 0>, 0.8, <-1.5, 1.2, 0>, 0.4, 2.5 } box { <-1, -2, -3>, <1, 2, 0> } pigment { rgb <0.9, 0.3, 0.1> } }
lemon { <1, -1, 0>, 0, <1.2, 1, 0>, 0.7, 3 pigment { rgb <0.2, 0.8, 0.3> } }
