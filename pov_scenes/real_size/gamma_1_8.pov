// Stone, wood and turned shapes, at 640x480 under `assumed_gamma 1.8`, antialiased by both methods.
// size: 640x480
// switches: +A0.3
// switches: +A0.3 +AM2
#version 3.7;
global_settings { assumed_gamma 1.8 }
camera { location <0, 2, -6> look_at <0, 0.6, 0> angle 45 }
light_source { <-5, 7, -6>, rgb 1 }
disc { 0, y, 40 pigment { marble turbulence 0.7 color_map { [0 rgb <0.8, 0.78, 0.7>] [0.6 rgb <0.5, 0.45, 0.4>] [1 rgb <0.15, 0.12, 0.1>] } scale 0.8 } }
sky_sphere { pigment { gradient y color_map { [0 rgb <0.8, 0.85, 0.9>] [1 rgb <0.1, 0.25, 0.6>] } } }
lathe { cubic_spline 7, <0.2, -0.2>, <0.6, 0>, <0.3, 0.5>, <0.75, 1>, <0.35, 1.5>, <0.5, 1.8>, <0.5, 2> translate -1.3*x pigment { wood turbulence 0.1 scale 0.15 rotate 80*x color_map { [0 rgb <0.6, 0.35, 0.15>] [1 rgb <0.3, 0.15, 0.05>] } } finish { phong 0.4 } }
superellipsoid { <0.3, 0.6> scale 0.7 rotate <20, 35, 0> translate <0.5, 0.8, -0.6> pigment { granite color_map { [0 rgb 0.1] [0.4 rgb <0.6, 0.3, 0.3>] [1 rgb 1] } scale 0.7 } }
cone { <1.9, 0, 0.8>, 0.7, <1.9, 1.7, 0.8>, 0.1 pigment { leopard scale 0.06 color_map { [0 rgb <0.9, 0.8, 0.2>] [1 rgb <0.2, 0.1, 0>] } } normal { bumps 0.3 scale 0.1 } finish { specular 0.5 } }
