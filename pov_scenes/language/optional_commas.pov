// Commas between items may be left out, and one may follow the last component.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
sphere { <-1 0 0> 0.6 pigment { rgb <0.9 0.5 0.2> } }
box { <0.5, -0.5, -0.5> <1.5, 0.5, 0.5> pigment { checker rgb 1 rgb <0.2 0.4 0.8> scale 0.3 } }
cone { <0 0.8 0> 0.3 <0, 1.4 0> 0 pigment { rgb <0.2, 0.8 0.3> } }
