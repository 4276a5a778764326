// Cones whose radii differ by a little keep a sound side between cylinder and cone.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
cone { <-1.5, -1, 0>, 0.6, <-1.5, 0.8, 0>, 0.599 pigment { rgb <0.9, 0.5, 0.3> } }
cone { <0, -1, 0>, 0.6, <0, 0.8, 0>, 0.59999 pigment { rgb <0.5, 0.9, 0.3> } }
cone { <1.5, -1, 0>, 0.6, <1.5, 0.8, 0>, 0.5999999 pigment { rgb <0.5, 0.3, 0.9> } }
