// `blend_mode` in a pigment_map blends the colours of its pigments.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1.6 pigment { gradient y scale 3.2 translate -1.6*y pigment_map { blend_mode 2 [0 checker rgb 1, rgb <0.8, 0.1, 0> scale 0.3] [1 rgb <0, 0.2, 0.9>] } } finish { emission 0.3 } }
