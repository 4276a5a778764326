// A surface of revolution and a lathe through the same points, cut by planes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
intersection { sor { 5, <0.3, -1>, <0.5, -0.7>, <0.7, 0>, <0.3, 0.7>, <0.5, 1> rotate -30*x } plane { y, 0.1 } translate -x pigment { rgb <0.8, 0.5, 0.2> } }
intersection { lathe { cubic_spline 5, <0.3, -1>, <0.5, -0.7>, <0.7, 0>, <0.3, 0.7>, <0.5, 1> rotate -30*x } plane { y, 0.1 } translate x pigment { rgb <0.2, 0.5, 0.8> } }
