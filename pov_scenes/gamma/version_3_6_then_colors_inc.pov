// An include gives back the version it found: 3.6 stays 3.6.
#version 3.6;
#include "colors.inc"
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { Orange } }
