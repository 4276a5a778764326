// Filter and transmit are blended linearly in every mode.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
plane { y, -1.7 pigment { checker rgb 1, rgb 0.3 } }
sphere { 0, 1.6 pigment { gradient x scale 3.2 translate -1.6*x color_map { blend_mode 2 [0 rgbt <0.9, 0.1, 0.3, 0.9>] [1 rgbf <0.1, 0.3, 0.9, 0.6>] } } }
