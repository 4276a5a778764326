// `blend_mode 3` in a color_map where `assumed_gamma` is 2.2.
#version 3.8;
global_settings { assumed_gamma 2.2 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1.6 pigment { gradient x color_map { blend_mode 3 [0 rgb <0.9, 0.1, 0.3>] [0.5 rgb <0.1, 0.9, 0.2>] [1 rgb <0.1, 0.3, 0.9>] } scale 3 translate 1.5*x } finish { emission 0.4 } }
