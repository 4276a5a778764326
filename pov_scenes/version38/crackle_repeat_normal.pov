// Crackle that repeats, in a pigment of its own form and in a normal.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
sphere { 0, 1.8 pigment { crackle form <1, 0, 0> repeat <2, 2, 2> color_map { [0 rgb <0.9, 0.5, 0.2>] [1 rgb 1] } scale 0.5 } normal { crackle 0.5 repeat <2, 2, 2> scale 0.3 } }
