// Blobs in a difference, an intersection and a clear merge, too large for POV-Ray's least distances to matter.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2000, -6000> look_at 0 angle 38 }
light_source { <-4000, 6000, -8000>, rgb 1 }
#declare B = blob { threshold 0.5 sphere { <-0.4, 0, 0>, 0.8, 1 } sphere { <0.4, 0.2, 0>, 0.8, 1 } }
union {
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference { object { B scale 1.3 } plane { -z, 0 pigment { rgb <0.9, 0.2, 0.2> } rotate 30*y } pigment { rgb <0.8, 0.5, 0.2> } translate -1.4*x }
difference { box { -0.6, 0.6 } object { B pigment { rgb <0.2, 0.5, 0.8> } translate -0.4*z } pigment { rgb <0.5, 0.8, 0.3> } rotate 20*y translate <1.3, -0.3, 0> }
intersection { object { B } cylinder { -y, y, 0.6 } pigment { rgb <0.7, 0.3, 0.6> } translate <0, 1.1, 0.6> }
merge { object { B } sphere { <0, 0.4, 0>, 0.35 } pigment { rgbf <0.9, 0.7, 0.5, 0.7> } translate <0.2, -0.7, -0.5> }
scale 1000 }
