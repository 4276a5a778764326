// Pigments in a map take the point where the pattern around them sees it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { gradient x pigment_map { [0.3 checker scale 0.2] [0.6 rgb <1, 0.5, 0>] [1 bozo scale 0.1] } turbulence 0.2 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { spherical pigment_map { [0 granite] [0.4 gradient y turbulence 0.5 scale 0.3] } scale 1.5 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { gradient y pigment_map { [0.5 gradient x pigment_map { [0.2 rgb 1] [0.8 rgb x] } scale 0.3] [0.5 leopard scale 0.05] } } }
