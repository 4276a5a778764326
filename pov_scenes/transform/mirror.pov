// A negative scale mirrors: the figure on the right is the left one in a looking glass.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Hook = union {
  box { <0, -0.9, -0.2>, <0.4, 0.9, 0.2> }
  box { <0.3, 0.5, -0.15>, <1.1, 0.8, 0.15> }
  cone { <0.3, -0.5, 0>, 0.3, <1.2, -0.3, -0.4>, 0.05 }
  pigment { rgb <0.8, 0.6, 0.4> }
};
object { Hook translate 0.4*x }
object { Hook translate 0.4*x scale <-1, 1, 1> }
