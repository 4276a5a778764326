// `no_shadow` on a union holds for its members.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union {
  sphere { <-1.2, 0.2, 0>, 0.5 }
  box { <-0.4, 0, -0.4>, <0.4, 0.8, 0.4> }
  no_shadow
  pigment { rgb <0.9, 0.8, 0.4> }
}
sphere { <1.3, 0.2, 0>, 0.5 pigment { rgb <0.4, 0.6, 0.9> } }
