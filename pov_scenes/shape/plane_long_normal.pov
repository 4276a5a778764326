// The length of a plane's normal does not matter, the distance stays in units of space.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { 10*y, -1 pigment { checker rgb 1, rgb 0.4 } }
plane { <-0.1, 0, 0>, -2 pigment { rgb <0.7, 0.6, 0.2> } }
