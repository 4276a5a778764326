// Rays of a `user_defined` camera from a circle towards its centre, whatever transforms follow.
#version 3.8;
global_settings { assumed_gamma 1 }
light_source { <5, 8, -6>, 0.8 }
plane { z, 2 pigment { checker rgb 1, rgb <0.3, 0.5, 1> } finish { emission 0.3 } }
sphere { 0, 0.3 pigment { rgb <1, 0.5, 0.2> } }
camera { user_defined location { function { 3 * cos(tau * x) } function { y } function { 3 * sin(tau * x) } } direction { function { -cos(tau * x) } function { 0 } function { -sin(tau * x) } } scale 0.5 rotate 20*z translate 0.1*y }
