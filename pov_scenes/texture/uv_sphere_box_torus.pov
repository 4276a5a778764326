// `uv_mapping`: spheres, boxes and tori keep their texture coordinates through all transforms.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare K = pigment { checker rgb <1, 0.8, 0.2> rgb <0.1, 0.3, 0.8> scale <0.1, 0.125, 1> }
sphere { <0.3, 0.2, 0.1>, 1 pigment { uv_mapping K } rotate 40*x scale <1, 0.8, 1.2> translate <-2, 0.8, 0> }
box { -1, <1, 0.6, 1> pigment { uv_mapping K } rotate <30, 30, 0> translate <2, 0.5, 0> }
torus { 0.8, 0.35 pigment { uv_mapping K } rotate -50*x scale 1.2 translate <-1.8, -1.4, 0> }
sphere { 0, 0.9 pigment { uv_mapping K } scale <-1, 1, 1> rotate 70*y translate <1.5, -1.4, 0> }
