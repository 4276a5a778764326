// A pattern behind a name or the default pigment keeps the map or the list that was given to the pattern before; its own colours are only
// for where there is none. Lists do not keep maps.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -8> look_at 0 angle 50 }
light_source { <5, 8, -6>, rgb 1 }
#declare Ball = sphere { 0, 0.75 }
#declare Fiery = pigment { bozo color_map { [0 rgb x] [0.5 rgb <1, 0.8, 0>] [1 rgb 1] } }
#declare Two = pigment { checker rgb <0.9, 0.2, 0.3> rgb <0.2, 0.4, 0.9> }
#declare Mixed = pigment { bozo pigment_map { [0 rgb <1, 0.6, 0.3>] [1 granite scale 0.2] } }
#declare Mean = pigment { average pigment_map { [0 rgb y] [1 rgb z] } }
#declare Plain = pigment { bozo }
#declare Rough = normal { bozo normal_map { [0 bumps 1 scale 0.1] [1 dents 0.3 scale 0.1] } }
#declare Steps = normal { bozo slope_map { [0 <0, 3>] [0.5 <1, -2>] [1 <0, 1>] } }
object { Ball pigment { Fiery marble scale 0.4 } translate <-2.4, 1.8, 0> }
object { Ball pigment { Fiery checker scale 0.3 } translate <-0.8, 1.8, 0> }
object { Ball pigment { Two gradient x scale 0.4 } translate <0.8, 1.8, 0> }
object { Ball pigment { Mixed wood scale 0.4 } translate <2.4, 1.8, 0> }
object { Ball pigment { Mixed average } translate <-2.4, 0, 0> }
object { Ball pigment { Mean granite } translate <-0.8, 0, 0> }
object { Ball pigment { Plain agate scale 0.4 } translate <0.8, 0, 0> }
object { Ball pigment { rgb 1 } normal { Rough marble scale 0.5 } translate <2.4, 0, 0> }
object { Ball pigment { rgb 1 } normal { Rough ripples scale 0.5 } translate <-2.4, -1.8, 0> }
object { Ball pigment { rgb 1 } normal { Steps marble scale 0.5 } translate <-0.8, -1.8, 0> }
object { Ball pigment { rgb 1 } normal { Rough average } translate <0.8, -1.8, 0> }
#default { pigment { Fiery } }
object { Ball pigment { leopard scale 0.1 } translate <2.4, -1.8, 0> }
