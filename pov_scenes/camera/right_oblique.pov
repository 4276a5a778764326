// Right and up need not be square to each other when there is no look_at.
// compare: channel<=98 pixels<=0.03% because "four rays pass through an edge of the box, to the last digit"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> right <1.33, 0.3, 0> up <0.2, 1, 0.1> direction z }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { -0.8, 0.8 pigment { rgb <0.8, 0.6, 0.4> } }
