// no_bump_scale in a texture holds for whatever normal its top layer has in the end, wherever the word stands; a pigment takes it
// without effect.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -8> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
#default { texture { normal { dents 0.6 scale 0.2 } no_bump_scale } }
#declare Ball = sphere { 0, 0.8 }
#declare Rough = normal { bumps 0.8 scale 0.2 }
#declare Kept = texture { pigment { rgb <1, 0.9, 0.7> } no_bump_scale }
#declare Layers =
  texture { pigment { rgb <0.7, 0.9, 1> } normal { Rough } }
  texture { pigment { checker rgbt 1 rgbt <1, 0.4, 0.3, 0.5> scale 0.3 } normal { Rough } }
object { Ball texture { pigment { rgb 1 } normal { Rough } scale 3 no_bump_scale } translate <-1.8, 0.9, 0> }
object { Ball texture { no_bump_scale pigment { bozo no_bump_scale scale 0.3 } normal { Rough } scale 0.4 } translate <0, 0.9, 0> }
object { Ball texture { Kept normal { Rough } scale 3 } translate <1.8, 0.9, 0> }
object { Ball texture { Kept } normal { Rough } scale <1, 0.4, 1> translate <-1.8, -0.9, 0> }
object { Ball texture { Layers no_bump_scale scale 3 } translate <0, -0.9, 0> }
object { Ball texture { pigment { rgb <0.8, 1, 0.8> } scale 3 } translate <1.8, -0.9, 0> }
