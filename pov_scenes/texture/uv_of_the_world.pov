// `uv_mapping`: shapes without texture coordinates of their own take x and y of the world, wherever they stand.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare K = pigment { checker rgb <1, 0.8, 0.2> rgb <0.1, 0.3, 0.8> scale <0.1, 0.125, 1> }
cylinder { -0.8*y, 0.8*y, 0.6 pigment { uv_mapping K } rotate 30*z translate -2.2*x }
cone { -0.8*y, 0.8, 0.8*y, 0.2 pigment { uv_mapping K } }
superellipsoid { <0.3, 0.3> pigment { uv_mapping K } scale 0.7 rotate 20 translate 2.2*x }
blob { threshold 0.3 sphere { -0.3*x, 1, 1 } sphere { 0.3*x, 1, 1 } pigment { uv_mapping K } translate <-1.5, 1.8, 0> }
prism { linear_spline -0.3, 0.3, 4, <-0.7, -0.7>, <0.7, -0.7>, <0, 0.7>, <-0.7, -0.7> pigment { uv_mapping K } rotate -60*x translate <1.5, 1.8, 0> }
disc { <0, -1.6, 0>, y - z, 0.9 pigment { uv_mapping K } }
plane { y, -2 pigment { uv_mapping K } }
