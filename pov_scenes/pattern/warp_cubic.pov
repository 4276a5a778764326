// `warp { cubic }`: a cross of six faces about a cube.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { checker scale 0.05 warp { cubic } rotate <20, 30, 0> } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { leopard color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] } scale 0.01 warp { cubic } translate <0.8, -0.2, 0> } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { image_map { "../texture/images/rgb.png" interpolate 2 } warp { cubic } rotate <20, 30, 0> translate <-0.8, 0, 0> } }
