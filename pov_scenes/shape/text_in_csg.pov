// Letters cut from a box, and a text cut by a sphere.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <2, 1.5, -5> look_at <2, 0.3, 0> }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
difference { box { <-0.2, -0.3, 0.1>, <4.2, 1, 1> pigment { rgb <0.2, 0.4, 1> } } text { ttf "timrom.ttf" "Quarz 8" 0.4, 0.06*x pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } scale 1.3 } rotate -20*x }
intersection { text { ttf "timrom.ttf" "Text" 0.5, 0 pigment { rgb <0.9, 0.7, 0.4> } finish { phong 0.5 } } sphere { <0.8, 0.3, 0>, 0.65 pigment { rgb 1 } } translate <1, -1.1, -0.5> }
