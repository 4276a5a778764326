// Boxes with a common face, turned about its axis together: the rounded point decides, as for boxes that are not turned.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <3, 10, -9> look_at 1.3*y angle 30 }
light_source { <-20, 30, -10> rgb 1 }
background { rgb <0.2, 0.3, 0.4> }
intersection {
  box { <-1, 0.3, -1>, <1, 1.3, 1> pigment { rgb <1, 0.2, 0.2> } }
  box { <-0.6, 1.3, -1.5>, <0.6, 1.8, 0.7> pigment { rgb <0.2, 0.4, 1> } }
  rotate 30*y
}
