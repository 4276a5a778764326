// height_field of a function of colours: each channel and then their grey is cut to 16 bits, seen in terraces.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.5, 1.2, -1.1> look_at <0.5, 0, 0.4> angle 60 }
light_source { <-3, 6, -5>, 1 }
#declare Rising = pigment { gradient x color_map { [0 rgb 0.5] [1 rgb 0.5002] } }
#declare Noise = pigment { bozo scale 0.3 color_map { [0 rgb <0.5, 0.50006, 0.499>] [1 rgb <0.50005, 0.5, 0.501>] } }
#macro Terraces(P)
  height_field { function 40, 30 { pigment { P } } translate <0, -0.5, 0> scale <1, 2000, 1> }
#end
object { Terraces(Rising) pigment { rgb <0.6, 0.8, 0.5> } translate <-0.55, -0.2, 0> }
object { Terraces(Noise) pigment { rgb <0.8, 0.7, 0.5> } translate <0.55, 0, 0> }
