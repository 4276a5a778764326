// `blend_mode` blends filter and transmit in linear light, in a color_map and a pigment_map, where `assumed_gamma` is srgb.
#version 3.8;
global_settings { assumed_gamma srgb }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { z, 3 pigment { checker rgb 1, rgb <0.9, 0.6, 0.2> } finish { emission 0.8 diffuse 0 } }
sphere { -1.4*x, 1.3 pigment { gradient x color_map { blend_mode 1 [0 rgbft <0.9, 0.4, 0.3, 0.1, 0>] [1 rgbft <0.2, 0.9, 0.6, 0.2, 0.7>] } scale 3 translate 1.5*x } }
sphere { 1.4*x, 1.3 pigment { gradient y pigment_map { blend_mode 2 [0 rgbft <0.9, 0.4, 0.3, 0, 0.1>] [1 rgbft <0.2, 0.9, 0.6, 0.8, 0>] } scale 3 translate 1.5*y } }
