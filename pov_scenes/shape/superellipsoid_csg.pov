// Superellipsoids cut, sheared and clear.
// compare: channel<=76 pixels<=0.02% because "POV-Ray shades two points of the cut that the formula, sampled along their shadow rays, leaves in the light"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare S = superellipsoid { <0.4, 0.6> }
difference { object { S scale 0.8 } cylinder { -2*z, 2*z, 0.4 pigment { rgb <0.9, 0.2, 0.2> } } rotate 40*y translate <-1.4, 0.3, 0> pigment { rgb <0.8, 0.5, 0.2> } }
difference { box { -0.7, 0.7 } object { S scale 0.6 translate -0.6*z } rotate 20*y translate <1.4, 0.2, 0> pigment { rgb <0.2, 0.5, 0.8> } }
object { S scale <0.6, -0.3, 0.5> matrix <1, 0.5, 0, 0, 1, 0, 0.4, 0, 1, 0, -0.8, -0.8> pigment { rgb <0.5, 0.8, 0.3> } }
object { S scale 0.5 rotate 30 translate <0, 0.7, -0.5> pigment { rgbf <0.9, 0.9, 1, 0.8> } finish { reflection 0.1 } interior { ior 1.3 } }
