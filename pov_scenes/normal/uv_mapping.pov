// `uv_mapping` in a `normal`, in a texture with bumps, in a `normal_map`, and at an object.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare K = pigment { checker rgb <1, 0.8, 0.2> rgb <0.1, 0.3, 0.8> scale <0.1, 0.125, 1> }
sphere { 0, 1 pigment { rgb 1 } normal { uv_mapping bumps 0.8 scale 0.05 } rotate 40*y translate <-1.2, 1.1, 0> }
sphere { 0, 1 texture { uv_mapping pigment { rgb <1, 0.8, 0.5> } normal { gradient x 0.6 scale 0.1 } finish { phong 1 } } rotate <20, 40, 0> translate <1.2, 1.1, 0> }
box { -0.8, 0.8 uv_mapping pigment { rgb <0.5, 0.8, 1> } normal { bumps 0.8 scale 0.05 } rotate <30, 40, 0> translate <-1.2, -1.2, 0> }
torus { 0.7, 0.4 pigment { rgb <0.7, 1, 0.7> } normal { gradient y normal_map { [0 uv_mapping bumps 0.9 scale 0.1] [1 ripples 0.5 scale 0.2] } } rotate <-50, 0, 20> translate <1.2, -1.2, 0> }
