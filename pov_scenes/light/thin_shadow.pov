// Below a thousandth of a unit a blocker casts no shadow, above it does: two plates over a floor.
// compare: channel<=123 pixels<=7.1% because "POV-Ray loses the shadow of what is nearer than 1/1000"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 3, -4> look_at <0, 0, 0> right 4*x up 3*y }
light_source { <0, 9, 0>, rgb 1 }
plane { y, 0 pigment { rgb <0.9, 0.9, 0.6> } }
box { <-1.5, 0.0008, -0.6>, <-0.3, 0.0009, 0.6> pigment { rgb 0.5 } no_image }
box { <0.3, 0.0013, -0.6>, <1.5, 0.0015, 0.6> pigment { rgb 0.5 } no_image }
