// In version 3.71 `filter all` and `transmit all` add to every pixel, as in 3.7.
#version 3.71;
global_settings { assumed_gamma 1 }
camera { orthographic location <0.5, 0.5, -5> right 1.33*x up y }
light_source { <5, 8, -6>, 1 }
plane { z, 1 pigment { checker rgb 1 rgb <0.1, 0.3, 0.8> scale 0.1 } finish { emission 0.5 } }
plane { z, 0 pigment { image_map { png "../texture/images/alpha.png" filter all 0.3 transmit all 0.2 } } }
