// A height field cuts and is cut; what lies below it is solid, without walls.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.6, 1.3, -1.1> look_at <0.5, 0.35, 0.5> }
light_source { <-3, 5, -4> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
difference {
  box { <0.05, -0.1, 0.05>, <0.95, 0.9, 0.6> pigment { rgb <0.8, 0.3, 0.2> } }
  height_field { png "heights/deep.png" smooth pigment { rgb <0.9, 0.7, 0.4> } }
  rotate -10*x
}
intersection {
  height_field { png "heights/deep.png" pigment { rgb <0.5, 0.9, 0.4> } }
  sphere { <0.5, 0.4, 0.8>, 0.45 pigment { rgb <0.2, 0.3, 1> } }
  translate 0.2*z
}
