// With a negative threshold and a negative strength the solid is all outside the surface.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
intersection { box { -0.9, 0.9 } blob { threshold -0.3 sphere { <-0.2, 0, -0.8>, 1, -1 } } pigment { rgb <0.8, 0.5, 0.2> } rotate 20*y translate -1.3*x }
intersection { box { -0.9, 0.9 } blob { threshold 0.3 sphere { <-0.2, 0, -0.8>, 1, 1 } inverse } pigment { rgb <0.2, 0.5, 0.8> } rotate 20*y translate 1.3*x }
