// Text whose thickness is 0 shows its letters, and casts their shadows.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.2, -5> look_at <0, 0.5, 0> angle 42 }
light_source { <-4, 5, -6>, rgb 1 }
light_source { <4, 3, 6>, rgb 0.5 }
plane { y, -0.2 pigment { rgb 0.8 } }
plane { z, 3 pigment { checker rgb 0.4 rgb 0.6 scale 0.5 } }
text { ttf "timrom.ttf" "Flat @8g" 0, 0 pigment { rgb <1, 0.6, 0.2> } finish { specular 0.4 reflection 0.1 } translate -1.6*x }
text { ttf "crystal.ttf" "W" 0, 0 pigment { rgbf <0.4, 1, 0.6, 0.7> } rotate 50*y translate <-1.4, 1, -0.5> }
text { ttf "cyrvetic.ttf" "Zero" 0, 0.1*x pigment { rgb <0.3, 0.5, 1> } rotate -160*y translate <1.6, 1, 0> }
difference {
  text { ttf "cyrvetic.ttf" "cut" 0, 0 pigment { rgb <0.9, 0.2, 0.4> } }
  sphere { <0.5, 0.2, 0>, 0.2 }
  translate <-0.9, 1, 0>
}
