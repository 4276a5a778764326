// `max_extent` of a pigment that shows an image is the image's resolution.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <-4, 6, -8>, rgb 1 }
#declare P = pigment { image_map { png "../texture/images/rgb.png" } scale 3 }
#declare Copy = pigment { P rotate 30*y }
#declare A = array[1] { P }
box { -1, <0.05, 0.05, 0.1> * max_extent(P) pigment { rgb max_extent(Copy) / 40 } }
sphere { <-2, 0, 0>, max_extent(A[0]).y / 20 pigment { rgb <1, 0.6, 0.3> } }
