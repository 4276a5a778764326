// A map without a pattern before it has no effect: the pigment stays black, and so does the density.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -5> look_at 0 }
light_source { <5, 8, -9>, 1 }
background { rgb <0.3, 0.4, 0.6> }
#declare Ends = color_map { [0 rgb x] [1 rgb y] };
sphere { <-1.2, 0, 0>, 1 pigment { color_map { Ends } scale 0.2 } finish { phong 1 } }
sphere { <1.2, 0, 0>, 1 pigment { pigment_map { [0 rgb 1] [1 checker rgb 0 rgb 1] } } finish { phong 1 } }
box { <-2, 1, 1>, <2, 2, 2> hollow pigment { rgbt 1 } interior { media { emission 0.4 density { color_map { Ends } } } } }
