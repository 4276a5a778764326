// A blob behind a rotation, an uneven scaling and a shear.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare B = blob { threshold 0.5 sphere { <-0.5, 0, 0>, 0.9, 1 } sphere { <0.5, 0.2, 0>, 0.8, 1 } cylinder { <0, -0.8, 0>, <0, 0.8, 0>, 0.5, 1 } }
object { B scale <1, 0.7, 1.5> rotate <20, 60, 10> translate <-1.3, 0.4, 0> pigment { rgb <0.8, 0.5, 0.2> } }
object { B matrix <1, 0.4, 0, -0.3, 1, 0.2, 0, 0, 1, 1.2, 0.1, 0> pigment { rgb <0.2, 0.5, 0.8> } finish { specular 0.5 } }
