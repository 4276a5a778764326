// `uv_mapping`: lathes, surfaces of revolution with their caps, and an ovus, around their axis and along it.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare K = pigment { checker rgb <1, 0.8, 0.2> rgb <0.1, 0.3, 0.8> scale <0.1, 0.125, 1> }
lathe { cubic_spline 6, <0, -1.5>, <0, -1>, <1, -0.5>, <0.4, 0.3>, <0.2, 1>, <0, 1.5> pigment { uv_mapping K } rotate 20*z translate -2.4*x }
sor { 6, <0.1, -1.5>, <0.6, -1>, <1, -0.5>, <0.7, 0.3>, <0.5, 1>, <0.1, 1.5> pigment { uv_mapping K } rotate -50*x translate 0.6*y }
sor { 6, <0.1, -1.5>, <0.6, -1>, <1, -0.5>, <0.7, 0.3>, <0.5, 1>, <0.1, 1.5> open pigment { uv_mapping K } rotate 60*x translate <2.4, 0.6, 0> }
ovus { 0.8, 0.4 pigment { uv_mapping K } rotate 30*z translate -1.6*y }
