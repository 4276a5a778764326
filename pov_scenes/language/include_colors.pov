// Names from the standard file colors.inc.
#version 3.7;
global_settings { assumed_gamma 1 }
#include "colors.inc"
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1 pigment { checker color White color Gray50 } }
sphere { <-1.4, 0, 0>, 0.6 pigment { Red } }
sphere { <0, 0, 0>, 0.6 pigment { color SpringGreen } }
sphere { <1.4, 0, 0>, 0.6 pigment { color Orange*0.6 + Blue*0.4 } }
