// Prisms in differences and intersections, sheared, mirrored and clear.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare P = prism { cubic_spline -0.5, 0.5, 7, <1, -1>, <0, 0.7>, <-0.9, 0>, <0, -0.7>, <1, 0.1>, <0, 0.7>, <-1, -1> }
difference { object { P } cylinder { -y, y, 0.3 pigment { rgb <0.9, 0.2, 0.2> } } rotate <-50, 20, 0> translate <-1.6, 0.3, 0> pigment { rgb <0.8, 0.5, 0.2> } }
difference { sphere { 0, 0.8 } object { P scale <0.6, 2, -0.6> rotate 70*x pigment { rgb <0.2, 0.5, 0.8> } } rotate 20*y translate <1.5, 0.2, 0> pigment { rgb <0.5, 0.8, 0.3> } }
object { P matrix <0.7, 0.4, 0, 0, 0.6, 0, 0.3, 0, 0.7, 0, -0.8, -0.8> pigment { rgb <0.7, 0.3, 0.6> } }
intersection { prism { conic_sweep 0, 1, 4, <-0.6, -0.5>, <0.6, -0.5>, <0, 0.7>, <-0.6, -0.5> } box { <-1, -1, -0.2>, <1, 0.8, 1> } translate <0.1, 0.3, 0> pigment { rgbf <0.9, 0.9, 1, 0.7> } }
