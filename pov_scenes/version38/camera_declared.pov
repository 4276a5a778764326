// A declared camera, which has the aspect ratio of the picture as well.
#version 3.8;
global_settings { assumed_gamma 1 }
#declare Near = camera { location <0, 2, -6> look_at 0 angle 38 };
camera { Near rotate -40*y }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { -0.8, 0.8 pigment { checker rgb 1, rgb <0.3, 0.5, 0.8> scale 0.41 } }
