// A number after `scale` stands for all three axes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <1, 0, 0>, 1 scale 0.5 translate <-1.5, -0.5, 0> pigment { rgb <0.9, 0.9, 0.3> } }
box { -1, 1 scale 0.6 rotate 30 translate <1.2, 0, 0> pigment { rgb <0.3, 0.9, 0.7> } }
