// One rotation about each axis, by the left hand.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Flag = box { <0, -0.3, -0.1>, <1, 0.3, 0.1> };
object { Flag rotate 50*x translate <-2, 0.8, 0> pigment { rgb <0.9, 0.3, 0.3> } }
object { Flag rotate 50*y translate <-0.5, -0.3, 0> pigment { rgb <0.3, 0.9, 0.3> } }
object { Flag rotate 50*z translate <1, -0.6, 0> pigment { rgb <0.3, 0.3, 0.9> } }
