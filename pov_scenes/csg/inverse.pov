// `inverse` swaps inside and outside: the intersection with an inverse sphere is a difference.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
intersection {
  box { -0.8, 0.8 }
  sphere { <0, 0.4, -0.8>, 0.7 inverse }
  rotate 25*y
  pigment { rgb <0.9, 0.6, 0.7> }
}
