// no_bump_scale in a texture with a pattern holds for the pattern and all its entries, but not for those of material_map; in an entry
// it holds for the entry alone, and the scaling around it does not lengthen its bumps.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -8> look_at 0 angle 50 }
light_source { <5, 8, -6>, rgb 1 }
#declare Ball = sphere { 0, 0.8 }
#declare Rough = normal { bumps 0.8 scale 0.2 }
#declare A = texture { pigment { rgb <1, 0.9, 0.7> } normal { Rough } }
#declare B = texture { pigment { rgb <0.5, 0.8, 1> } normal { Rough } finish { phong 0.6 } }
#declare Dots = function (x, y, z) { select(sin(20*x)*sin(20*y), 0, 1) }
object { Ball texture { gradient x texture_map { [0 A] [1 B] } no_bump_scale scale 2 } translate <-1.8, 1.8, 0> }
object { Ball texture { no_bump_scale checker texture { A } texture { B } scale 0.7 } translate <0, 1.8, 0> }
object { Ball texture { tiles { texture { A } tile2 texture { B } } scale 0.6 no_bump_scale } translate <1.8, 1.8, 0> }
object { Ball texture { gradient x texture_map { [0 A no_bump_scale] [1 B] } scale 2 } translate <-1.8, 0, 0> }
object { Ball texture { average texture_map { [1 A] [2 B no_bump_scale] } scale 0.6 } translate 0 }
object { Ball
  texture { material_map { function 8, 8 { Dots(x, y, z) } texture { A } texture { B no_bump_scale } } scale 1.6 no_bump_scale }
  translate <1.8, 0, 0> }
object { Ball
  texture { gradient y texture_map { [0 checker texture { A } texture { B } scale 0.4] [1 A] } scale 2 no_bump_scale }
  translate <-1.8, -1.8, 0> }
object { Ball texture { uv_mapping A no_bump_scale scale 0.5 } translate <0, -1.8, 0> }
object { Ball texture { gradient x texture_map { [0 A] [1 B] } no_bump_scale scale <1, 2, 0.7> rotate 30*z } translate <1.8, -1.8, 0> }
