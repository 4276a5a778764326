// Letters of three fonts, with kerning, descents and a space.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 1.5, -5> look_at <2, 0.3, 0> }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
text { ttf "timrom.ttf" "AVoid gj (x)" 0.5, 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } translate 0.9*y }
text { ttf "cyrvetic" "AVoid gj (x)" 0.5 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } }
text { ttf "crystal.ttf", "ABC % @ &8" 0.5, 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } translate -0.9*y }
