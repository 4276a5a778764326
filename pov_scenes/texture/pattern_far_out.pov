// A pattern far from the origin stays sharp.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <100000, 2, -6> look_at <100000, 0, 0> angle 38 }
light_source { <99996, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.6, 0.2, 0.2> translate <0.3, 0, 0.4> } }
sphere { <100000, 0, 0>, 1 pigment { rgb <0.7, 0.7, 0.3> } }
