// Polygons clipped, cut by a solid and seen through clear ones.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare P = polygon { 5, <-0.8, -0.8>, <0.8, -0.8>, <0.8, 0.8>, <-0.8, 0.8>, <-0.8, -0.8> }
intersection { object { P } sphere { 0, 1 } rotate 30*y translate <-1.5, 0.2, 0> pigment { rgb <0.8, 0.5, 0.2> } }
difference { object { P } sphere { 0, 0.5 } rotate -30*y translate <0.4, 0.4, 0> pigment { rgb <0.2, 0.5, 0.8> } }
object { P clipped_by { cylinder { -z, z, 0.7 } } scale <1, -0.6, 1> matrix <0.6, 0.4, 0, 0, 1, 0, 0, 0, 1, 1.9, 0.2, 0> pigment { rgb <0.5, 0.8, 0.3> } }
object { P scale 0.7 rotate <60, 20, 0> translate <0.2, -0.7, -1> pigment { rgbf <1, 0.9, 0.8, 0.7> } }
