// Superellipsoids from a cushion to a double pyramid, all convex.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
superellipsoid { <0.3, 0.3> scale 0.6 rotate <20, 30, 0> translate <-1.7, 0.6, 0> pigment { rgb <0.8, 0.5, 0.2> } }
superellipsoid { <1, 0.3> scale 0.6 rotate <60, 30, 0> translate <0, 0.7, 0> pigment { rgb <0.2, 0.5, 0.8> } finish { phong 0.5 } }
superellipsoid { <0.2, 1> scale 0.6 rotate <60, 30, 0> translate <1.7, 0.6, 0> pigment { rgb <0.5, 0.8, 0.3> } }
superellipsoid { <2, 2> scale 0.6 rotate <0, 20, 0> translate <-0.9, -0.7, -0.6> pigment { rgb <0.7, 0.3, 0.6> } }
superellipsoid { <0.05, 0.02> scale 0.5 rotate <30, 20, 0> translate <0.9, -0.7, -0.6> pigment { rgb <0.9, 0.8, 0.2> } }
