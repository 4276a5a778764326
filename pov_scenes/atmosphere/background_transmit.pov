// The transmit of a background dims its colour; its filter does not.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
background { rgbft <0.5, 0.6, 0.7, 0.3, 0.25> }
sphere { 0, 0.9 pigment { rgb <0.9, 0.6, 0.3> } }
