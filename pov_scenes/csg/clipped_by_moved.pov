// Transforms behind the objects of `clipped_by` and `bounded_by` move all of these objects, and not the one that they clip.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Post = cylinder { -2*y, 2*y, 0.9 }
#declare Turn = transform { rotate 40*z }
box { -0.8, 0.8 clipped_by { Post scale 0.9 rotate 30*z } bounded_by { box { -1, 1 } scale 2 } rotate <20, 30, 0> translate <-2.2, 1.2, 0> pigment { rgb <0.9, 0.5, 0.3> } }
sphere { 0, 0.9 clipped_by { plane { y, 0.5 } plane { x, 0.4 } object { Post scale 0.5 inverse } transform { Turn } } rotate -20*x translate <0, 1.2, 0> pigment { rgb <0.3, 0.6, 0.9> } }
union { box { -0.7, 0.7 } torus { 0.9, 0.2 } clipped_by { sphere { 0, 1 } #for (I, 0, 1) translate 0.2*x #end } rotate <20, 30, 0> translate <2.2, 1.2, 0> pigment { rgb <0.4, 0.9, 0.4> } }
box { -0.8, 0.8 rotate 20*y clipped_by { Post matrix <1, 0, 0, 0.4, 1, 0, 0, 0, 1, 0, 0, 0> } clipped_by { sphere { 0, 0.9 } translate 0.2*x } rotate <20, 30, 0> translate <-2.2, -1.2, 0> pigment { rgb <0.9, 0.8, 0.3> } }
box { -0.8, 0.8 bounded_by { sphere { 0, 0.8 } translate <0.2, 0, 0> } clipped_by { bounded_by } rotate <20, 30, 0> translate <0, -1.2, 0> pigment { rgb <0.7, 0.4, 0.9> } }
intersection { sphere { 0, 0.9 } sphere { 0.2*y, 0.9 } bounded_by { box { -1, 1 } scale 0.6 translate <0.3, 0, -0.6> } translate <2.2, -1.2, 0> pigment { rgb <0.3, 0.8, 0.8> } }
