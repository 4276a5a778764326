// `uv_mapping` at an object: its transforms do not move its own texture, but those of what it holds.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare U = pigment { gradient x color_map { [0 rgb <1, 0.2, 0.1>] [1 rgb <0.1, 0.3, 1>] } }
#declare K = pigment { checker rgb <1, 0.8, 0.2> rgb <0.1, 0.3, 0.8> scale <0.1, 0.125, 1> }
sphere { 0, 1 uv_mapping texture { pigment { K scale 2 } finish { phong 1 } } texture { pigment { gradient y color_map { [0 rgbt 1] [1 rgb 1] } scale 0.3 } } rotate <30, 50, 0> scale <1, 0.8, 1> translate <-2.4, 1, 0> }
union { sphere { 0, 0.8 pigment { U } translate 0.9*x } box { -0.6, 0.6 rotate 30 translate -0.6*x } uv_mapping pigment { K } rotate 30*z translate <1, 1, 0> }
union { sphere { 0, 0.9 uv_mapping translate -0.8*x } sphere { 0.9*x, 0.8 } pigment { K scale 2 } rotate 40*y translate <-1.4, -1.3, 0> }
difference { box { -0.9, 0.9 } sphere { <0.9, 0.9, -0.9>, 1 } uv_mapping pigment { K } rotate 30*y translate <1.8, -1.3, 0> }
