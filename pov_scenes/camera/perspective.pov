// The word `perspective` names the default kind.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { perspective location <1, 2, -5> look_at <0.2, 0, 0> angle 50 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { -0.8, 0.8 pigment { rgb <0.5, 0.8, 0.3> } }
