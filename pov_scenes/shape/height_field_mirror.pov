// A height field that mirrors itself, with its shadows.
// compare: channel<=30 pixels<=0.1% because "POV-Ray loses shadows of cells near their edges; its own mesh of these triangles has them"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.6, 1.3, -1.1> look_at <0.5, 0.35, 0.5> }
light_source { <-3, 5, -4> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
height_field { png "heights/grey.png" smooth pigment { rgb 0.5 } finish { reflection 0.5 } scale <1, 1.5, 1> }
sphere { <0.5, 1, 0.5>, 0.1 pigment { rgb x } }
