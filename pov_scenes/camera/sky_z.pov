// With z as sky the ground is the plane of x and y.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { sky z location <3, -6, 3> look_at <0, 0, 0.3> right -1.33*x angle 35 }
light_source { <-4, -8, 9>, rgb 1 }
plane { z, -0.5 pigment { checker rgb 0.9, rgb <0.4, 0.5, 0.3> } }
cone { <0, 0, -0.49>, 0.9, <0, 0, 1.4>, 0.2 pigment { rgb <0.9, 0.7, 0.3> } }
