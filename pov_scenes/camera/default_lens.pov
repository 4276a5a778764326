// Location and look_at alone: right is 1.33 x, up is y.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { 0, 0.9 pigment { checker rgb 1, rgb <0.8, 0.2, 0.2> scale 0.3 } }
