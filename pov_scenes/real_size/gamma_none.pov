// Layers and maps without any gamma, at 640x480 under version 3.6 without `assumed_gamma`, antialiased by both methods.
// size: 640x480
// switches: +A0.3
// switches: +A0.3 +AM2
#version 3.6;
global_settings { max_trace_level 5 }
camera { location <-2, 3, -6> look_at <0, 0.6, 0> angle 40 }
light_source { <-8, 12, -6>, rgb 1 spotlight point_at <0, 0.5, 0> radius 12 falloff 25 }
light_source { <5, 6, -9>, rgb 0.4 }
plane { y, 0 pigment { brick rgb 0.75, rgb <0.6, 0.25, 0.2> scale 0.12 } }
box { <-0.9, 0, -0.9>, <0.9, 1.8, 0.9> rotate 25*y pigment { crackle scale 0.5 color_map { [0 rgb 0] [0.15 rgb <0.7, 0.6, 0.4>] [1 rgb <0.9, 0.85, 0.7>] } } texture { pigment { spiral1 3 color_map { [0 rgbt <1, 1, 1, 1>] [0.7 rgbt <0.2, 0.2, 0.6, 0.4>] [1 rgbt <0.1, 0.1, 0.4, 0.2>] } scale 0.7 translate 0.9*y } finish { phong 0.6 } } }
cylinder { <1.9, 0, -0.4>, <1.9, 1.1, -0.4>, 0.5 open pigment { radial frequency 12 color_map { [0.5 rgb <0.9, 0.9, 0.2>] [0.5 rgb <0.1, 0.2, 0.5>] } translate 1.9*x } interior_texture { pigment { rgb <0.8, 0.2, 0.2> } } }
prism { 0, 1, 6, <0, 0>, <1, 0>, <1.2, 0.6>, <0.5, 0.4>, <0.1, 1>, <0, 0> translate <-2.4, 0, -0.2> pigment { gradient <1, 1, 0.4> scale 0.4 color_map { [0 rgb <0.1, 0.4, 0.3>] [1 rgb <0.7, 0.9, 0.6>] } } }
