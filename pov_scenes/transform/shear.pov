// A matrix may shear: the upright cylinders lean, their normals with them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Post = cylinder { -0.9*y, 0.9*y, 0.45 pigment { rgb <0.9, 0.6, 0.4> } finish { phong 0.6 } };
object { Post matrix <1, 0, 0,  0.7, 1, 0,  0, 0, 1,  -1.2, 0, 0> }
object { Post matrix <1, 0, 0,  0, 1, 0.8,  0.5, 0, 1,  1.2, 0, 0> }
