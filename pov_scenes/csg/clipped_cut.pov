// The clipping of a part that is taken away clips all that is left, at any depth.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 2.5, -5> look_at 0 angle 34 }
light_source { <5, 8, -6>, rgb 1 }
background { rgb 0.3 }
plane { y, -1.4 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference {
  box { <-1.3, -0.7, -0.7>, <-0.1, 0.7, 0.7> pigment { rgb <0.9, 0.5, 0.3> } }
  sphere { <-0.3, 0.5, -0.5>, 0.6 clipped_by { plane { x, -0.4 } } pigment { rgb <0.3, 0.8, 0.4> } }
}
difference {
  box { <0.1, -0.7, -0.7>, <1.3, 0.7, 0.7> pigment { rgb <0.9, 0.5, 0.3> } }
  union {
    sphere { <1.1, 0.5, -0.5>, 0.5 clipped_by { plane { -y, 0.2 } } }
    sphere { <0.3, -0.5, -0.5>, 0.4 }
    pigment { rgb <0.3, 0.8, 0.4> }
  }
}
