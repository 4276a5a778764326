// Before 3.5 a cylinder camera of an unknown type keeps the projection before it.
#version 3.1;
camera { cylinder 5 location <0, 1, -4> look_at 0 }
light_source { <-3, 5, -6>, 1 }
sphere { 0, 1 pigment { rgb <1, 0.5, 0.2> } }
plane { y, -1 pigment { checker rgb 1 rgb 0.3 } }
