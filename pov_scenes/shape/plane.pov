// Planes go on to the horizon; distance is counted along the normal.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1 pigment { rgb <0.3, 0.6, 0.3> } }
plane { z, 9 pigment { rgb <0.5, 0.7, 1> } }
plane { <1, 0.2, -0.4>, -4 pigment { rgb <0.8, 0.5, 0.4> } }
