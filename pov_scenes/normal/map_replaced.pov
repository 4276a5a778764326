// Normal: the last of two maps counts, and a comma may follow a name.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 40 }
light_source { <-3, 5, -6>, 1 }
#declare Rough = normal { bumps 1 scale 0.2 }
#declare Slopes = slope_map { [0 <0, 1>] [0.5 <1, 0>] [1 <0, -1>] }
#declare Normals = normal_map { [0 bumps 1 scale 0.2] [1 dents 1 scale 0.2] }
sphere { <-1.1, 1.1, 0>, 1 pigment { rgb 1 } normal { gradient x slope_map { Slopes } normal_map { Normals } } }
sphere { <1.1, 1.1, 0>, 1 pigment { rgb 1 } normal { gradient x normal_map { Normals } slope_map { Slopes } } }
sphere { <-1.1, -1.1, 0>, 1 pigment { rgb 1 } normal { Rough, 0.3 } }
sphere { <1.1, -1.1, 0>, 1 pigment { rgb 1 } normal { Rough, slope_map { Slopes } } }
