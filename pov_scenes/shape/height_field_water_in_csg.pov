// Below the water level a height field is solid, but the water is not seen.
// compare: channel<=65 pixels<=0.1% because "POV-Ray loses shadows of cells near their edges; its own mesh of these triangles has them"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.6, 1.3, -1.1> look_at <0.5, 0.35, 0.5> }
light_source { <-3, 5, -4> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
difference {
  box { <0.05, -0.1, 0.05>, <0.95, 0.9, 0.6> pigment { rgb <0.8, 0.3, 0.2> } }
  height_field { png "heights/deep.png" water_level 0.5 pigment { rgb <0.9, 0.7, 0.4> } }
  rotate -10*x
}
intersection {
  height_field { png "heights/deep.png" water_level 0.45 pigment { rgb <0.5, 0.9, 0.4> } }
  box { <0.2, 0.1, 0.5>, <0.9, 0.7, 0.9> pigment { rgb <0.2, 0.3, 1> } }
  translate 0.2*z
}
