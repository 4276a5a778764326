// `blend_gamma bt709` and `bt2020`.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Ball(At) sphere { At, 1 finish { emission 0.4 } pigment { gradient x scale 2 translate At + 1*x color_map { #end
Ball(<-1.2, 0, 0>) blend_mode 2 blend_gamma bt709 [0 rgb <1, 0.1, 0>] [1 rgb <0, 0.3, 1>] } } }
Ball(<1.2, 0, 0>) blend_mode 2 blend_gamma bt2020 [0 rgb <1, 0.1, 0>] [1 rgb <0, 0.3, 1>] } } }
