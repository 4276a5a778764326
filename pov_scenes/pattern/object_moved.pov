// Transforms behind the object of the pattern `object` move it alone: in pigments, normals and textures, with colours and with lists.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -9> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Post = cylinder { -2*y, 2*y, 0.4 }
#declare Bits = array[1] { box { -0.4, 0.4 } }
box { -0.8, 0.8 pigment { object { Post scale 1.3 rotate 40*z rgb x, rgb <0.9, 0.8, 0.2> } } rotate <20, 30, 0> translate <-2.2, 1.2, 0> }
sphere { 0, 0.9 pigment { object { Bits[0] translate <0.2, 0.1, -0.7> matrix <1, 0, 0, 0.4, 1, 0, 0, 0, 1, 0, 0, 0> pigment { rgb <0.3, 0.6, 0.9> } pigment { checker scale 0.1 } } } translate <0, 1.2, 0> }
box { -0.8, 0.8 pigment { object { union { sphere { 0, 0.5 } Post } transform { rotate 30*z } } rotate 10*y } rotate <20, 30, 0> translate <2.2, 1.2, 0> }
box { -0.8, 0.8 texture { object { Post rotate 30*z texture { pigment { rgb 1 } } texture { pigment { rgb <0.9, 0.4, 0.4> } finish { phong 1 } } } } rotate <20, 30, 0> translate <-2.2, -1.2, 0> }
sphere { 0, 0.9 pigment { rgb 0.9 } normal { object { Post rotate 30*z normal { bumps 1 scale 0.1 } normal { ripples 2 scale 0.1 } } } translate <0, -1.2, 0> }
box { -0.8, 0.8 pigment { object { sphere { 0, 0.5 } scale <1.5, 1, 1> rgb <0.2, 0.5, 0.3> rgb 1 } warp { repeat x } turbulence 0.1 } rotate <20, 30, 0> translate <2.2, -1.2, 0> }
