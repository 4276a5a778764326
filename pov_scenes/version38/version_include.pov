// Standard includes that save the version and restore it leave the defaults of version 3.8.
#version 3.8;
#include "colors.inc"
#include "math.inc"
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 }
sphere { 1.5*x, 0.5 pigment { color Orange } }
