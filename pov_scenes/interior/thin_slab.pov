// A slab thicker than the least depth of a ray shows both faces, a thinner one only the first.
// compare: channel<=24 pixels<=36% because "POV-Ray loses the rear face of the slab, which is nearer than 1/10000"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
box { <-1.5, -0.8, 0>, <-0.2, 0.9, 0.00013> pigment { rgbf <0.9, 0.5, 0.4, 0.6> } }
box { <0.2, -0.8, 0>, <1.5, 0.9, 0.00005> pigment { rgbf <0.9, 0.5, 0.4, 0.6> } }
