// Rainbows that are jittered: the one declared last takes its random number first.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -10> look_at <0, 4, 0> angle 85 }
background { rgb <0.2, 0.5, 0.7> }
#declare Colours = color_map { [0 rgbf <1, 0.5, 1, 1>][0.5 rgbf <0.2, 1, 0.2, 0.8>][1 rgbf <1, 0.2, 0.2, 0.8>] }
rainbow { angle 42.5 width 5 distance 1e7 direction <-0.2, -0.2, 1> jitter 0.02 color_map { Colours } }
rainbow { angle 37 width 5 distance 1e7 direction <-0.2, -0.2, 1> jitter 0.01 color_map { Colours } }
