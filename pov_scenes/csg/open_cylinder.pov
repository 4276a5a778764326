// An open cylinder still has an inside, but no caps: the intersection with a box has open ends.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
intersection { box { -0.8, 0.8 } cylinder { <0, -0.6, 0>, <0, 0.6, 0>, 0.7 open } rotate -35*x translate -1.1*x pigment { rgb <0.9, 0.6, 0.5> } }
difference { sphere { 0, 0.9 } cylinder { <0, 0, -0.5>, <0, 0, -2>, 0.5 open } rotate 20*y translate 1.1*x pigment { rgb <0.5, 0.7, 0.9> } }
