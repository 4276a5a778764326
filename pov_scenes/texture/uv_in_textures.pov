// `uv_mapping` in textures: before a finish, a map, a list, and in the entries of maps.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare U = pigment { gradient x color_map { [0 rgb <1, 0.2, 0.1>] [1 rgb <0.1, 0.3, 1>] } }
#declare K = pigment { checker rgb <1, 0.8, 0.2> rgb <0.1, 0.3, 0.8> scale <0.1, 0.125, 1> }
sphere { 0, 1 texture { uv_mapping pigment { K } finish { phong 1 } scale <2, 1, 1> } rotate 40*y translate <-2.2, 1.1, 0> }
sphere { 0, 1 texture { uv_mapping gradient x texture_map { [0 pigment { K }] [1 pigment { U } finish { reflection 0.3 }] } scale 0.3 } rotate 40*y translate <0, 1.1, 0> }
sphere { 0, 1 texture { gradient y texture_map { [0 uv_mapping pigment { K }] [1 pigment { U } normal { bumps 0.5 scale 0.1 }] } scale 0.5 } rotate 40*x translate <2.2, 1.1, 0> }
sphere { 0, 1 texture { uv_mapping checker texture { pigment { U } } texture { pigment { K } } scale 0.2 } translate <-2.2, -1.2, 0> }
sphere { 0, 1 texture { uv_mapping average texture_map { [1 pigment { U }] [2 pigment { K }] } } translate <0, -1.2, 0> }
sphere { 0, 1 texture { pigment { gradient x pigment_map { [0 uv_mapping K] [1 U] } } } translate <2.2, -1.2, 0> }
