// Superellipsoids with exponents above two have hollow sides and spikes.
// compare: channel<=54 pixels<=0.02% because "POV-Ray misses two spikes that the formula, sampled along their rays, shows"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.31 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
superellipsoid { <3, 3> rotate <20, 30, 0> translate <-1.3, 0.2, 0> pigment { rgb <0.8, 0.5, 0.2> } }
superellipsoid { <4, 0.5> rotate <70, 20, 0> translate <1.1, 0.5, 0> scale 0.9 pigment { rgb <0.2, 0.5, 0.8> } }
superellipsoid { <0.4, 3> scale 0.8 rotate <70, 20, 0> translate <0.3, -0.6, -0.6> pigment { rgb <0.5, 0.8, 0.3> } }
