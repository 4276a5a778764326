// From version 3.8 on the pigment is white by default.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1 }
plane { y, -1 pigment { rgb <0.2, 0.4, 0.6> } }
