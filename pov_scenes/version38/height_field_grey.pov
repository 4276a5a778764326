// Height fields of a grey PNG of eight bits, whose heights are those of the file.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0.17, 1.93, -2.41> look_at <0.05, 0.2, 0> angle 50 }
light_source { <5, 5, -8>, 1 shadowless }
height_field { png "../texture/images/grey.png" translate <-1.1, 0, -0.5> scale <1, 0.5, 1> pigment { rgb <1, 0.8, 0.5> } }
height_field { png "../texture/images/grey.png" smooth translate <0.1, 0, -0.5> scale <1, 0.5, 1> pigment { rgb <0.6, 0.8, 1> } }
