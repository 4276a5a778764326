// A rotation by a vector turns about x, then y, then z; the parts in that order give the same.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Brick = box { <-0.6, -0.3, -0.2>, <0.6, 0.3, 0.2> };
object { Brick rotate <30, 50, 70> translate -1.1*x pigment { rgb <0.9, 0.6, 0.3> } }
object { Brick rotate 30*x rotate 50*y rotate 70*z translate 1.1*x pigment { rgb <0.3, 0.6, 0.9> } }
