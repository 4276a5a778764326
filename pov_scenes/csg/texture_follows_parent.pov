// A member's own pattern moves with the parent's transform; the parent's pattern does so too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
union {
  box { <-1.2, -0.6, -0.6>, <0, 0.6, 0.6> pigment { checker rgb 1, rgb <0.8, 0.2, 0.2> scale 0.3 } }
  sphere { <0.9, 0, 0>, 0.7 }
  pigment { checker rgb 1, rgb <0.2, 0.2, 0.8> scale 0.3 }
  rotate <20, 30, 15>
}
