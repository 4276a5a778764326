// Quadrics without bounds: a cylinder along x, a paraboloid and a pair of planes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
quadric { <0, 1, 1>, <0, 0, 0>, <0, 0, 0>, -0.1 pigment { rgb <0.8, 0.5, 0.2> } translate 1.2*y }
quadric { <1, 0, 1>, <0, 0, 0>, <0, 1, 0>, 0 pigment { rgb <0.2, 0.5, 0.8> } translate <0.3, 0.6, 0> }
quadric { <0, 0, 1>, <0, 0, 0>, <0, 0, 0>, -16 pigment { rgb <0.5, 0.8, 0.3> } inverse }
