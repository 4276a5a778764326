// A declared camera may be transformed where it is used.
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Cam = camera { location <0, 2, -6> look_at 0 angle 38 };
camera { Cam rotate -40*y }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { -0.8, 0.8 pigment { checker rgb 1, rgb <0.3, 0.5, 0.8> scale 0.41 } }
