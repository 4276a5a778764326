// Levels are rounded in the working space where `assumed_gamma` is srgb.
#version 3.8;
global_settings { assumed_gamma srgb }
camera { orthographic location -z direction z up y right x }
plane { z, 0 pigment { gradient x color_map { [0 rgb <0, 1, 0.2>] [1 rgb <1, 0.3, 0.6>] } translate 0.5*x } finish { emission 1 diffuse 0 } }
