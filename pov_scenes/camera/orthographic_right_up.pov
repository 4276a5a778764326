// Orthographic with right and up: they are the size of the picture.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <2, 3, -5> look_at 0 right 5*x up 4*y }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { -0.8, 0.8 pigment { rgb <0.3, 0.6, 0.9> } }
