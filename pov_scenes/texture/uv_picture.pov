// `uv_mapping` of pictures on a sphere and a box, and of a material by their pixels.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 0.6 diffuse 0.4 } }
camera { location <0, 2, -9> look_at 0 angle 40 }
light_source { <4, 6, -8>, rgb 1 }
#declare P = pigment { image_map { function 24, 24 { pigment { wood turbulence 0.1 color_map { [0 rgb <1, 0.2, 0.1>] [0.5 rgb 1] [1 rgb <0.1, 0.3, 1>] } scale 0.3 } } interpolate 2 } }
sphere { 0, 1.5 pigment { uv_mapping P } rotate 30*y translate -1.8*x }
box { -1, 1 uv_mapping pigment { P scale 0.5 } rotate <-30, 30, 0> translate 1.8*x }
