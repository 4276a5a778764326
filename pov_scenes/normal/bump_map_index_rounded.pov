// Heights by index of a picture without a palette, interpolated: rounding decides where they are 0 and where the grey.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -10*z angle 22 look_at 0 }
light_source { <1000, 2000, -3000>, 1 }
sphere { -0.9*x, 0.9 pigment { rgb 0.9 } finish { phong 0.2 } normal { bump_map { png "../texture/images/grey.png" interpolate 4 use_index bump_size 3 } scale 1.5 } }
box { <0.1, -0.9, -0.5>, <1.8, 0.8, 1> pigment { rgb 0.9 } normal { bump_map { png "../texture/images/grey.png" interpolate 2 use_index bump_size 3 } scale 1.1 } rotate 10*x }
