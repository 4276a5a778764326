// A `user_defined` camera takes the origin and the direction of its rays from functions of the image point.
#version 3.8;
global_settings { assumed_gamma 1 }
light_source { <5, 8, -6>, 0.8 }
plane { z, 2 pigment { checker rgb 1, rgb <0.3, 0.5, 1> } finish { emission 0.3 } }
sphere { 0, 0.3 pigment { rgb <1, 0.5, 0.2> } }
camera { user_defined location { function { x } function { y } function { -5 } } direction { function { 0 } function { 0 } function { 1 } } }
