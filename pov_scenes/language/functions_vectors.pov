// vlength, vdot, vcross, vnormalize, vrotate and vaxis_rotate.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare A = <1.2, 0.3, -0.4>;
#declare B = <-0.3, 0.8, 0.5>;
sphere { A, vdot(A, B) + 0.5 pigment { rgb <0.9, 0.4, 0.4> } }
sphere { B, vlength(B)/4 pigment { rgb <0.4, 0.9, 0.4> } }
sphere { vcross(A, B), 0.3 pigment { rgb <0.4, 0.4, 0.9> } }
sphere { vnormalize(A)*-1.5, 0.3 pigment { rgb <0.9, 0.9, 0.4> } }
cylinder { 0, vrotate(A, <20, 60, 100>), 0.1 pigment { rgb <0.9, 0.4, 0.9> } }
cylinder { 0, vaxis_rotate(A, <1, 1, 0>, 130), 0.1 pigment { rgb <0.4, 0.9, 0.9> } }
