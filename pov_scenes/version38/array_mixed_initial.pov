// A mixed array takes its values in braces, with or without a size.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A = array mixed[3] { sphere { -2*x, 0.8 }, pigment { rgb <1, 0.5, 0.2> }, <2, 0, 0> }
#declare B = array mixed { 0.7, "name", box { -0.5, 0.5 } }
object { A[0] pigment { A[1] } }
sphere { A[2], B[0] }
object { B[2] rotate 30*y }
