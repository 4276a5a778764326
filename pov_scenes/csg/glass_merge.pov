// Overlapping transparent members of a merge show no inner surfaces.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
merge {
  sphere { <-0.5, 0, 0>, 0.9 }
  box { <-0.2, -0.6, -0.7>, <1.4, 0.6, 0.7> }
  pigment { rgbf <0.9, 0.6, 0.5, 0.7> }
}
