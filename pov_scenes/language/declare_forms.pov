// Definitions may be repeated, refer to themselves, and hold whole solids with textures.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare N = 1;
#declare N = N + 0.5;
#declare N = N*N;
#declare Thing = union { sphere { 0, 0.5 } box { <-0.2, 0, -0.2>, <0.2, 1, 0.2> } pigment { rgb <0.4, 0.8, 0.4> } };
object { Thing translate -x }
object { Thing scale N/2 pigment { rgb <0.8, 0.4, 0.4> } translate x }
