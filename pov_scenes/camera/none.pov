// Without a camera the default one looks along z from the origin.
#version 3.7;
global_settings { assumed_gamma 1 }
light_source { <-4, 6, -8>, rgb 1 }
sphere { <0.4, 0, 4>, 1 pigment { rgb <0.9, 0.5, 0.3> } }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
