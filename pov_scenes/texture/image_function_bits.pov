// A picture of a function keeps 16 bits of each channel: what is below 0 or above 1 comes round again, filter is lost.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -5> look_at 0 angle 45 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -2 pigment { checker rgb <0.9, 0.8, 0.3> rgb <0.3, 0.4, 0.8> scale 0.4 } finish { ambient 1 diffuse 0 } }
#macro Card(P, At)
  box { <-0.9, -0.7, 0>, <0.9, 0.7, 0.1> hollow pigment { image_map { function 30, 20 { pigment { P } } } translate -0.5 scale 1.8 } finish { ambient 0.7 diffuse 0.3 } translate At }
#end
#declare Beyond = pigment { gradient x color_map { [0 rgb <-0.5, 0.2, 1.4>] [1 rgb <1.6, 0.8, -0.3>] } }
#declare Tinted = pigment { gradient y color_map { [0 rgbf <1, 0.4, 0.2, 0.9>] [1 rgbf <0.3, 0.9, 0.5, 0>] } }
#declare Clear = pigment { bozo scale 0.2 color_map { [0 rgbt <1, 0.4, 0.2, -0.3>] [1 rgbt <0.3, 0.9, 0.5, 1.2>] } }
#declare Both = pigment { wood scale 0.4 color_map { [0 rgbft <1, 0.4, 0.2, 0.5, 0.5>] [1 rgbft <0.3, 0.9, 0.5, 0.5, 0.1>] } }
Card(Beyond, <-1, 0.8, 0>)
Card(Tinted, <1, 0.8, 0>)
Card(Clear, <-1, -0.8, 0>)
Card(Both, <1, -0.8, 0>)
