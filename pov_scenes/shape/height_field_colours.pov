// Red and green of coloured PNG, PPM and BMP files are heights.
// compare: channel<=130 pixels<=0.1% because "POV-Ray loses shadows of cells near their edges; its own mesh of these triangles has them"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.6, 1.3, -1.1> look_at <0.5, 0.35, 0.5> }
light_source { <-3, 5, -4> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
height_field { png "heights/colour.png" pigment { rgb x } scale <0.3, 0.6, 1> }
height_field { ppm "heights/colour" pigment { rgb y } scale <0.3, 0.6, 1> translate 0.33*x }
height_field { "heights/colour.bmp" pigment { rgb z } scale <0.3, 0.6, 1> translate 0.66*x }
