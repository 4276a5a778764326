// Heights of JPEG files: red and green of colours, and grey.
// The light is shadowless, since POV-Ray loses shadows of cells near their edges.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.9, 1.3, -1.1> look_at <0.9, 0.35, 0.5> }
light_source { <-3, 5, -4> rgb 1 shadowless }
background { rgb <0.1, 0.2, 0.3> }
height_field { jpeg "../texture/images/quarter.jpg" smooth pigment { rgb <0.9, 0.7, 0.4> } scale <0.85, 0.5, 1> }
height_field { "../texture/images/grey.jpg" smooth pigment { rgb <0.5, 0.7, 0.9> } scale <0.85, 0.5, 1> translate 0.95*x }
