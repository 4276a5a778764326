// Quartic tori in CSG, sheared, and a cone-like cubic without bounds.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare T = quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -2.18, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1.82, 0, 0, 0, 0, 1, 0, -2.18, 0, 0.8281> sturm scale 0.6 }
difference { object { T } plane { z, -0.2 pigment { rgb <0.9, 0.2, 0.2> } } rotate -40*x translate <-1.5, 0.3, 0> pigment { rgb <0.8, 0.5, 0.2> } }
difference { box { -0.6, 0.6 } object { T scale 0.9 rotate 90*x translate -0.6*z pigment { rgb <0.2, 0.5, 0.8> } } rotate 20*y translate <1.5, 0.2, 0> pigment { rgb <0.5, 0.8, 0.3> } }
object { T matrix <1, 0.4, 0, 0, -1.5, 0, 0.3, 0, 1, 0, 0.6, 0> pigment { rgbf <0.9, 0.9, 1, 0.8> } }
intersection { cubic { <0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, 0> } box { <-0.7, -0.7, -0.7>, 0.7 } translate <0, -0.7, -0.7> pigment { rgb <0.7, 0.3, 0.6> } }
