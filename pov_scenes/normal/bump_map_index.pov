// Heights by index, interpolated as whole numbers; a picture without a palette has its grey all the same.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
box { <-1, -1, -0.5>, <0.4, 1, 0.5> pigment { rgb 0.8 } normal { bump_map { png "../texture/images/palette.png" use_index interpolate 2 bump_size 0.4 } scale 0.7 } }
plane { y, -1.07 pigment { rgb 0.6 } normal { bump_map { gif "../texture/images/palette.gif" use_index interpolate 3 bump_size 0.3 } rotate 90*x scale 2 } }
plane { z, 4 pigment { rgb <0.9, 0.7, 0.5> } normal { bump_map { png "../texture/images/grey.png" use_index interpolate 3 bump_size 6 } scale 1.3 } }
