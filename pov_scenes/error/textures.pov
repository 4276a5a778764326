// Fine patterns: no edges, but no peace either.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.2, -5> look_at 0 angle 42 }
light_source { <-4, 6, -8>, rgb 0.8 }
plane { y, -1 pigment { granite color_map { [0 rgb 0.1] [1 rgb <0.9, 0.8, 0.7>] } scale 0.3 } }
sphere { <-1, 0, 0>, 0.9 pigment { marble turbulence 1 color_map { [0 rgb 0.8] [0.6 rgb 0.3] [1 rgb <0.1, 0.1, 0.3>] } scale 0.15 } finish { phong 0.3 } }
sphere { <1, 0, 0>, 0.9 pigment { leopard color_map { [0 rgb <0.2, 0.1, 0>] [0.2 rgb <0.8, 0.6, 0.3>] } scale 0.03 } }
