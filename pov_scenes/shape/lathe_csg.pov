// Lathes in differences and intersections: a closed one, and one that its open ends close out of sight.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Solid = lathe { cubic_spline 6, <0.5, -1.5>, <0, -0.7>, <0.7, -0.4>, <0.4, 0.3>, <0, 0.7>, <-0.5, 1> }
#declare Shell = lathe { 3, <0.4, -0.7>, <0.8, 0>, <0.5, 0.7> }
difference { object { Solid } box { <0, -1, -1>, <1, 1, 0> pigment { rgb <0.9, 0.2, 0.2> } rotate 20*y } rotate 20*x translate <-1.7, 0.3, 0> pigment { rgb <0.8, 0.5, 0.2> } }
difference { object { Shell } plane { z, -0.1 pigment { rgb <0.9, 0.2, 0.2> } } rotate -30*x translate <0, 0.4, 0> pigment { rgb <0.5, 0.8, 0.3> } }
difference { box { -0.7, 0.7 } object { Shell scale <0.7, 1.2, 0.7> rotate 70*x pigment { rgb <0.2, 0.5, 0.8> } } rotate 20*y translate <1.8, 0.1, 0> pigment { rgb <0.7, 0.3, 0.6> } }
intersection { object { Solid } sphere { 0, 0.6 } scale <1, 0.6, 1> translate <0.2, -0.9, -0.8> pigment { rgbf <0.9, 0.9, 1, 0.7> } }
