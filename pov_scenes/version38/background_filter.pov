// Filter and transmit of a background dim its colour, directly, in a mirror and behind a sky.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
background { rgbft <0.5, 0.6, 0.7, 0.3, 0.25> }
sky_sphere { pigment { gradient y color_map { [0 rgbt 1] [0.3 rgbft <0.9, 0.5, 0.3, 0.2, 0.5>] } } }
plane { y, -1 pigment { rgb <0.3, 0.2, 0.1> } finish { reflection 0.7 } }
sphere { 0, 0.9 pigment { rgb <0.9, 0.6, 0.3> } }
