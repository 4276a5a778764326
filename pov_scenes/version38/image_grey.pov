// A grey PNG of eight bits as pattern and as bumps, where its values are those of the file.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Map = color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] }
plane { -z, -2 pigment { image_pattern { png "../texture/images/grey.png" } color_map { Map } scale 2 } finish { emission 1 diffuse 0 } }
box { <-1.4, 0, -0.1>, <0, 1.4, 0> pigment { rgb 0.8 } normal { bump_map { png "../texture/images/grey.png" bump_size 4 } scale 1.4 } }
