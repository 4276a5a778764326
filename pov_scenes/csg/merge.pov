// An opaque merge looks like a union.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
merge {
  sphere { <-0.5, 0, 0>, 0.8 }
  sphere { <0.5, 0, 0>, 0.8 }
  torus { 1, 0.2 rotate 15*z }
  pigment { rgb <0.5, 0.8, 0.4> }
}
