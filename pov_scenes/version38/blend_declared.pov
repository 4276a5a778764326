// A declared map keeps its own blending, whatever precedes its name.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -5> look_at 0 right 4*x up 3*y }
#declare Plain = color_map { [0 rgb <0, 1, 0.1>] [1 rgb <1, 0, 0.3>] }
#declare Encoded = color_map { blend_mode 2 blend_gamma 1.5 [0 rgb <0, 1, 0.1>] [1 rgb <1, 0, 0.3>] }
#declare Pigments = pigment_map { blend_mode 3 [0 rgb <0, 1, 0.1>] [1 rgb <1, 0, 0.3>] }
#default { finish { emission 1 diffuse 0 } }
box { <-2, 0.75, 0>, <2, 1.5, 1> pigment { gradient x color_map { blend_mode 2 Plain } scale 4 translate 2*x } }
box { <-2, 0, 0>, <2, 0.75, 1> pigment { gradient x color_map { blend_mode 0 Encoded } scale 4 translate 2*x } }
box { <-2, -0.75, 0>, <2, 0, 1> pigment { gradient x color_map { blend_gamma 3 Encoded } scale 4 translate 2*x } }
box { <-2, -1.5, 0>, <2, -0.75, 1> pigment { gradient x pigment_map { blend_mode 1 Pigments } scale 4 translate 2*x } }
