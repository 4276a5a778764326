// With no_bump_scale a bumped normal stays as long as the bumps make it: so slope patterns see it, and so entries of maps take
// part in the mean; what a map says counts for its entries.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -8> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
#declare Ball = sphere { 0, 0.8 }
#declare Steep = pigment { slope y color_map { [0 rgb 0] [1 rgb <1, 0.9, 0.7>] } }
object { Ball texture { pigment { Steep } normal { bumps 0.7 no_bump_scale } } translate <-1.8, 0.9, 0> }
object { Ball
  texture { pigment { bozo } normal { average normal_map { [1 bumps 0.7 no_bump_scale] [2 dents 0.8 no_bump_scale] } } }
  translate <0, 0.9, 0>
}
object { Ball
  texture { pigment { bozo } normal { average normal_map { [1 bumps 0.7] [1 bumps -0.3] } no_bump_scale } }
  translate <1.8, 0.9, 0>
}
object { Ball
  texture { pigment { Steep } normal { gradient x normal_map { [0 bumps 0.7 no_bump_scale] [1 dents 0.8 no_bump_scale] } scale 0.6 rotate 30 } }
  translate <-1.8, -0.9, 0>
}
object { Ball
  texture { pigment { bozo } normal { bumps 0.7 no_bump_scale } }
  texture { pigment { slope y color_map { [0 rgbt 0] [1 rgbt 1] } } finish { ambient 0 } }
  translate <0, -0.9, 0>
}
object { Ball
  texture { pigment { Steep } normal { bumps 0.7 no_bump_scale scale <0.5, 1, 0.7> } scale <1, 2, 1> rotate 30 }
  translate <1.8, -0.9, 0>
}
