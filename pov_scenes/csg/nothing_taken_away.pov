// An intersection of nothing holds all, so that nothing is left where it is taken away.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 2.5, -5> look_at 0 angle 34 }
light_source { <5, 8, -6>, rgb 1 }
background { rgb 0.3 }
plane { y, -1.4 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference { sphere { -0.8*x, 0.6 pigment { rgb x } } difference { } }
difference { difference { } box { <0.3, -0.5, -0.5>, <1.2, 0.4, 0.3> pigment { rgb <0.9, 0.5, 0.3> } } }
