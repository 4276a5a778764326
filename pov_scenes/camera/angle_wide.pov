// A wide angle stretches the rim of the picture.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0.5, -2.2> look_at 0 angle 120 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-2.6, 0, 0>, 0.9 pigment { rgb <0.9, 0.6, 0.4> } }
sphere { <2.6, 0, 0>, 0.9 pigment { rgb <0.9, 0.6, 0.4> } }
