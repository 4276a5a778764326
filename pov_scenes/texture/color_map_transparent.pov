// Filter and transmit in colour maps.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { checker scale 0.3 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { bozo color_map { [0.3 rgbt <1, 0, 0, 1>] [0.5 rgbf <0, 1, 0, 0.8>] [0.7 rgb 1] } scale 0.3 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { gradient x color_map { [0 rgbft <1, 1, 0, 0.5, 0.5>] [1 rgb <0, 0, 1>] } } }
