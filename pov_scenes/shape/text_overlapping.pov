// Letters that overlap show their inner surfaces.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 1.5, -5> look_at <2, 0.3, 0> }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
text { ttf "timrom.ttf" "OOO" 0.5, -0.3*x pigment { rgbt <0.9, 0.7, 0.4, 0.7> } scale 2 translate -0.3*y }
