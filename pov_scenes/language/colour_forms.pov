// Colours by `rgb`, by channel words in any order, and by a vector after `color`.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Base = color red 0.9 green 0.4;
sphere { <-2, 0.5, 0>, 0.45 pigment { rgb <0.3, 0.6, 0.9> } }
sphere { <-0.7, 0.5, 0>, 0.45 pigment { color blue 0.8 red 0.4 } }
sphere { <0.7, 0.5, 0>, 0.45 pigment { colour <0.2, 0.8, 0.5> } }
sphere { <2, 0.5, 0>, 0.45 pigment { Base } }
sphere { <-2, -0.6, 0>, 0.45 pigment { Base green 0.9 } }
sphere { <-0.7, -0.6, 0>, 0.45 pigment { color Base blue 0.7 filter 0.5 } }
sphere { <0.7, -0.6, 0>, 0.45 pigment { rgb 0.5 green 1 } }
sphere { <2, -0.6, 0>, 0.45 pigment { rgb <1, 0.5> } }
