// Declared objects made from declared objects keep their own state.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare A = box { -0.3, 0.3 pigment { rgb <0.9, 0.5, 0.3> } };
#declare B = object { A rotate 30*y translate 0.8*x };
#declare C = union { object { A } object { B } rotate 20*z };
object { C translate -1.6*x }
object { C scale 0.8 rotate 90*y translate 1.2*x }
