// The working space may have the curve of BT.709.
#version 3.8;
global_settings { assumed_gamma bt709 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.9 }
sphere { 0, 1.2 pigment { rgb <0.8, 0.5, 0.2> } finish { phong 0.5 } }
sphere { <-2, 0, 1>, 1 pigment { srgb <0.3, 0.6, 0.9> } }
sphere { <2, 0, 1>, 1 pigment { gradient y color_map { blend_mode 1 [0 rgb <0.1, 0, 0>] [1 rgb <0.2, 0.9, 0.4>] } } }
plane { y, -1.2 pigment { checker rgb 0.02 rgb 0.7 } finish { reflection 0.1 } }
