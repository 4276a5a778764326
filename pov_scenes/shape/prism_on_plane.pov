// Clear prisms that stand on a plane and a box, and tops of opaque ones flush with a box: roundings decide what shows.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 2.3, -4.4> look_at 0.2*y angle 42 }
light_source { <20, 40, -30>, 1 }
background { rgb <0.4, 0.5, 0.7> }
#declare Checks = pigment { checker rgb <1, 1, 0.6>, rgb <0.3, 0.3, 0.6> scale 0.31 }
plane { y, 0 pigment { Checks } }
box { <0.2, 0, -1>, <2, 0.2, 1.3> pigment { Checks } }
#declare Outline = prism { linear_spline 0, 0.6, 6, <0.3, -0.8>, <0.6, 0.2>, <0.4, 0.7>, <-0.6, 0.6>, <-0.6, -0.5>, <0.3, -0.8> }
#declare Clear = pigment { rgbf <0.8, 1, 0.9, 0.8> }
object { Outline translate <-1.1, 0, -0.2> pigment { Clear } }
object { Outline rotate 30*y scale 0.8 translate <1, 0.2, -0.4> pigment { Clear } }
prism { cubic_spline 0.05, 0.2, 6, <0.8, 0.6>, <1.7, 0.7>, <1.2, 1.2>, <0.8, 0.6>, <1.7, 0.7>, <1.2, 1.2> pigment { rgb x } }
