// Quadrics in differences, intersections and merges, one of them inverse.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference { sphere { 0, 0.9 } quadric { <1, 0, 1>, <0, 0, 0>, <0, 0, 0>, -0.09 pigment { rgb <0.2, 0.5, 0.8> } rotate 60*x } pigment { rgb <0.8, 0.5, 0.2> } translate -1.2*x }
intersection { box { -0.8, 0.8 } quadric { <1, 1, 1>, <0, 0, 0>, <0, 0, 0>, -0.9 inverse } pigment { rgb <0.5, 0.8, 0.3> } rotate 30*y translate <1.2, -0.2, 0> }
merge { quadric { <2, 1, 2>, <0, 0, 0>, <0, 0, 0>, -0.2 } quadric { <1, 2, 2>, <0, 0, 0>, <0, 0, 0>, -0.2 } pigment { rgbf <0.9, 0.6, 0.6, 0.7> } translate <0, 1, -0.5> }
