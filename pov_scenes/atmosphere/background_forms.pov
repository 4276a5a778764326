// A background takes a colour in any form; the last one counts.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
background { color red 1 }
background { color rgb <0.2, 0.4, 0.3>*1.5 }
sphere { 0, 0.9 pigment { rgb <0.9, 0.6, 0.3> } }
