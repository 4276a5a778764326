// A file is read again at each `#include`; its local names are its own.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Size = 0.4;
#include "include/ball.inc"
#declare Size = 0.8;
#include "include/ball.inc"
