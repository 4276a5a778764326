// Before 3.7 the transmit of a background is passed over.
#version 3.6;
global_settings { assumed_gamma 1 }
background { rgbt <0.5, 0.6, 0.7, 0.25> }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
sphere { 0, 0.9 pigment { rgb <0.9, 0.6, 0.3> } }
