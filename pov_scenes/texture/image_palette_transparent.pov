// `filter` and `transmit` of colours of a palette.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { checker scale 0.2 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { image_map { "images/palette.png" transmit 3, 0.8 filter 5, 0.7 } scale 1.3 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { image_map { "images/palette.gif" transmit all 0.3 transmit 2, 1 } translate 0.5 } }
