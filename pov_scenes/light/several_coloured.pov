// The light of several coloured lamps adds up.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -4>, rgb <1, 0.2, 0.2> }
light_source { <4, 6, -4>, rgb <0.2, 1, 0.2> }
light_source { <0, 6, 3>, rgb <0.2, 0.2, 1> }
plane { y, -1.01 pigment { rgb 0.9 } }
sphere { 0, 0.8 pigment { rgb 0.9 } finish { phong 0.5 } }
