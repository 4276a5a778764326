// A text seen from behind and from below, scaled unevenly.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 1.5, -5> look_at <2, 0.3, 0> }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
text { ttf "cyrvetic.ttf" "B8%&" 0.4, 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } scale <1.5, 2, 3> rotate <-40, 156, 10> translate <3.5, 0, 0> }
