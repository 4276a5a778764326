// The commas of `slope` may be left out, and its upper limits, which are 0 then.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 40 }
light_source { <5, 8, -6>, 1 }
#declare Shades = color_map { [0 rgb <0.9, 0.3, 0.1>] [0.5 rgb 0.9] [1 rgb <0.1, 0.4, 0.8>] }
sphere { -1.9*x, 0.9 pigment { slope { y 0.2 0.8 } color_map { Shades } } }
sphere { 0, 0.9 pigment { slope { y, 0.2 altitude y, -1 1 } color_map { Shades } } }
sphere { 1.9*x, 0.9 pigment { slope { y altitude y 0.3 } color_map { Shades } } }
