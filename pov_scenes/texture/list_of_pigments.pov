// Pigments in the lists of `checker`, `brick` and `hexagon`.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { brick pigment { rgb 0.5 } pigment { granite scale 0.5 } scale 0.1 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { checker pigment { bozo scale 0.2 } pigment { gradient x color_map { [0 rgb x] [1 rgb y] } scale 0.3 } scale 0.5 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { hexagon pigment { checker scale 0.1 } pigment { rgb 1 } pigment { leopard scale 0.05 } rotate 90*x scale 0.3 } }
