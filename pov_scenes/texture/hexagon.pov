// Hexagons of three colours tile the plane of x and z as endless columns.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
cylinder { -0.9*y, 0.4*y, 1.4 pigment { hexagon rgb <0.9, 0.9, 0.7>, rgb <0.7, 0.2, 0.2>, rgb <0.2, 0.3, 0.6> scale 0.3 } rotate -25*x }
