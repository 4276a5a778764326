// Surfaces of revolution in differences and intersections, sheared, mirrored and clear.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare S = sor { 6, <0.2, -1.2>, <0.3, -0.8>, <0.7, -0.2>, <0.2, 0.4>, <0.4, 0.8>, <0.5, 1.2> }
difference { object { S } box { <0, -1, -1>, <1, 1, 0> pigment { rgb <0.9, 0.2, 0.2> } rotate 20*y } rotate -25*x translate <-1.7, 0.3, 0> pigment { rgb <0.8, 0.5, 0.2> } }
difference { box { -0.6, 0.6 } object { S scale <1, -1, 0.8> rotate 70*x pigment { rgb <0.2, 0.5, 0.8> } } rotate 20*y translate <1.6, 0.2, 0> pigment { rgb <0.7, 0.3, 0.6> } }
intersection { sor { 5, <0.2, -1.2>, <0.3, -0.8>, <0.7, 0>, <0.3, 0.8>, <0.5, 1.2> open } sphere { 0, 0.6 } matrix <1, 0.4, 0, 0, 1, 0.3, 0, 0, 1, 0, 0.5, 0> pigment { rgb <0.5, 0.8, 0.3> } }
object { S scale 0.6 rotate 60*z translate <0.1, -0.9, -0.9> pigment { rgbf <0.9, 0.9, 1, 0.8> } finish { reflection 0.1 } interior { ior 1.3 } }
