// `cmap`, which the manual calls reserved, is a free name.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare cmap = color_map { [0 rgb <1, 0.8, 0.2>] [1 rgb <0.2, 0.4, 1>] }
sphere { 0, 1 pigment { gradient y color_map { cmap } } }
