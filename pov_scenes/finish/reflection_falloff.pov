// The falloff moves the growth of reflection toward grazing angles.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1.1, 0, 0>, 0.9 pigment { rgb 0.2 } finish { reflection { rgb <0.1, 0, 0>, rgb 1 falloff 3 } } }
sphere { <1.1, 0, 0>, 0.9 pigment { rgb 0.2 } finish { reflection { 0, 1 falloff 0.3 } } }
