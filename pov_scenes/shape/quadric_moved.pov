// Quadrics behind rotations, uneven scalings and shears.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Q = quadric { <1, 2, 1>, <0.4, -0.3, 0.6>, <0.1, 0, 0.2>, -0.5 }
object { Q scale <1, 0.5, 1> rotate <20, 30, 40> translate <-1.4, 0.5, 0> pigment { rgb <0.8, 0.5, 0.2> } }
object { Q matrix <1, 0.5, 0, 0, 1, 0.3, 0, 0, 1, 1.3, 0.3, 0> pigment { rgb <0.2, 0.5, 0.8> } finish { phong 0.6 } }
object { Q rotate 90*x scale <1.5, -0.7, 1> translate <0, -0.7, 0> pigment { rgb <0.5, 0.8, 0.3> } }
