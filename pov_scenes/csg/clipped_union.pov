// A clip of a union clips all members, in the union's own space.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union {
  torus { 0.8, 0.25 rotate 90*x }
  cylinder { -1.2*x, 1.2*x, 0.2 }
  clipped_by { box { <-2, -0.4, -2>, <2, 2, 2> } }
  rotate 30*z
  pigment { rgb <0.7, 0.4, 0.8> }
}
