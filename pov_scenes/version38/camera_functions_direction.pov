// A `user_defined` camera with functions of the direction alone has one location, and its transforms do not turn its rays.
#version 3.8;
global_settings { assumed_gamma 1 }
light_source { <5, 8, -6>, 0.8 }
plane { z, 2 pigment { checker rgb 1, rgb <0.3, 0.5, 1> } finish { emission 0.3 } }
sphere { 0, 0.3 pigment { rgb <1, 0.5, 0.2> } }
camera { user_defined direction { function { x } function { y } function { 1 + 0.3 * sin(10 * x) } } location <0, 0, -2> rotate 10*y }
