// alpha in a colour is filter, with a warning from version 1.6 on.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
plane { -z, -2 pigment { checker rgb 1 rgb 0.2 } finish { ambient 0.4 } }
#declare Tone = color green 1;
#declare Faint = color rgb <1, 0.5, 0> alpha 0.6;
sphere { <-1.4, 0.8, 0>, 0.7 pigment { bozo color_map { [0 color red 1 alpha 0.4] [1 color rgb y alpha 0.9] } scale 0.3 } }
sphere { <0, 0.8, 0>, 0.7 pigment { color Tone alpha 0.5 } }
sphere { <1.4, 0.8, 0>, 0.7 pigment { Faint } }
sphere { <-1.4, -0.8, 0>, 0.7 pigment { rgbt <1, 0, 0, 0.3> alpha 0.5 } }
sphere { <0, -0.8, 0>, 0.7 pigment { color red 1 filter 0.9 alpha 0.2 } }
sphere { <1.4, -0.8, 0>, 0.7 pigment { color alpha 0.8 blue 1 } }
