// Quadrics: an ellipsoid, a cylinder and a cone cut by boxes, a saddle and a hyperboloid.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
quadric { <1, 2, 1>, <0, 0, 0>, <0, 0, 0>, -0.5 pigment { rgb <0.8, 0.5, 0.2> } translate <-1.6, 0.6, 0> }
intersection { quadric { <1, 0, 1>, <0, 0, 0>, <0, 0, 0>, -0.25 } box { -0.7, 0.7 } pigment { rgb <0.2, 0.5, 0.8> } translate 1.6*x rotate 10*z }
intersection { quadric { <1, -1, 1>, <0, 0, 0>, <0, 0, 0>, 0 } box { <-1, -0.8, -1>, <1, 0.8, 1> } pigment { rgb <0.5, 0.8, 0.3> } translate <0, -0.3, 0> }
intersection { quadric { <1, 0, -1>, <0, 0, 0>, <0, -1, 0>, 0 } sphere { 0, 0.7 } pigment { rgb <0.7, 0.3, 0.6> } translate <-1.7, -0.7, 0> }
intersection { quadric { <1, -1, 1>, <0, 0, 0>, <0, 0, 0>, -0.04 } sphere { 0, 0.6 } pigment { rgb <0.9, 0.8, 0.2> } translate <0, 0.9, 0> }
