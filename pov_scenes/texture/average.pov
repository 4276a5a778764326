// `average` of pigments by weight.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { average pigment_map { [1 gradient x] [2 gradient y scale 0.5] [0.5 rgb <1, 0, 0>] } } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { average pigment_map { [1 bozo] [1 checker rgb 1 rgb 0] } turbulence 0.3 scale 0.4 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { average pigment_map { [1 rgbt <1, 0, 0, 0.8>] [3 rgbf <0, 1, 1, 0.4>] } } }
