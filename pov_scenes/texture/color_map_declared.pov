// Colour maps and pigment maps by name.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Rainbow = color_map { [0 rgb x] [0.5 rgb y] [1 rgb z] }
#declare Spots = pigment { bozo color_map { Rainbow } scale 0.2 }
#declare Stuff = pigment_map { [0.3 rgb 1] [0.7 Spots rotate 30] }
plane { -z, -1 pigment { gradient x color_map { Rainbow } } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { marble turbulence 0.5 color_map { Rainbow } scale 0.5 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { gradient x pigment_map { Stuff } } }
