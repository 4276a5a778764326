// A member with only a finish does not take the parent's pigment: it is black.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union {
  sphere { <-0.9, 0, 0>, 0.8 }
  sphere { <0.9, 0, 0>, 0.8 finish { phong 0.9 } }
  pigment { rgb <0.9, 0.5, 0.2> }
}
