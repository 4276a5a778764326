// Escapes hold in the names of files as well.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#include "\u0063olors.inc"
sphere { 0, 1 pigment { color Orange } }
