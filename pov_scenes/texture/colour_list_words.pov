// Colours of a list may be identifiers, `rgb`, or colour words in any mixture.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Sand = rgb <0.8, 0.7, 0.4>;
sphere { <-1.1, 0, 0>, 0.9 pigment { checker Sand, color red 0.5 blue 0.2 scale 0.3 } }
sphere { <1.1, 0, 0>, 0.9 pigment { hexagon color rgb 0.9 colour Sand*0.5 rgb <0.1, 0.4, 0.4> scale 0.3 rotate 90*x } }
