// Thin letters mirror a floor whose colour rounding decides: their faces have POV-Ray's last digits.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.5, -3> look_at <0.5, 0.3, 0> angle 38 }
light_source { <3, 5, -4> 1 }
background { rgb 0.1 }
text { ttf "timrom.ttf" "POV" 0.01, 0 pigment { rgb 0.2 } finish { reflection 0.7 } scale <0.7, 0.9, 0.6> rotate <-20, 25, 5> translate <-0.3, 0.2, 0> }
box { <-5, -1, -5>, <5, -0.1, 5> pigment { gradient y color_map { [0 rgb <0.9, 0.6, 0.2>] [0.9 rgb <0.2, 0.4, 0.9>] } translate -0.1*y } finish { ambient 0.6 } }
