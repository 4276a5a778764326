// A cylinder of negative radius looks like one of the positive radius.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
cylinder { <-1, -0.9, 0>, <-1, 0.8, 0>, 0.5 pigment { rgb <0.8, 0.5, 0.6> } }
cylinder { <1, -0.9, 0>, <1, 0.8, 0>, -0.5 pigment { rgb <0.8, 0.5, 0.6> } }
