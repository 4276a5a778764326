// A rainbow shows its colours around a direction, in front of what is far.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -9> look_at <0, 2, 0> angle 80 }
light_source { <-8, 12, -19>, rgb 1 }
#declare Colours = color_map { [0 rgbt <0.7, 0, 1, 1>] [0.2 rgbt <0.4, 0, 1, 0.6>] [0.5 rgbft <0, 1, 0.3, 0.5, 0.2>] [0.8 rgbt <1, 0.8, 0, 0.4>] [1 rgbt <1, 0, 0, 1>] }
background { rgb <0.2, 0.3, 0.5> }
box { <-40, -1, -4>, <40, 0, 60> pigment { checker rgb 0.9 rgb <0.2, 0.4, 0.3> scale 2 } }
sphere { <-3.5, 2, 0>, 1.5 pigment { rgb <0.9, 0.4, 0.3> } finish { reflection 0.3 } }
sphere { <3, 2, 3>, 1.5 hollow pigment { rgbf <0.9, 0.9, 1, 0.8> } interior { ior 1.3 } }
rainbow { angle 22 width 8 direction z distance 15 color_map { Colours } }
