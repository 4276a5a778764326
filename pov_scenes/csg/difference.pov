// A difference takes the further members away from the first.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference {
  box { -0.9, 0.9 }
  sphere { <0.3, 0.5, -0.9>, 0.9 }
  cylinder { <-2, 0, 0.1>, <2, 0, 0.1>, 0.4 }
  rotate <10, 30, 0>
  pigment { rgb <0.8, 0.4, 0.4> }
}
