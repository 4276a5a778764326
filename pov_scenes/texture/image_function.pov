// `image_map { function W, H { ... } }`: the values of a function as a picture.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { image_map { function 20, 10 { x * 1.7 - 0.3 } } scale 2 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { image_map { function 60, 40 { pigment { bozo color_map { [0.3 rgb <1, 0, 0>] [0.6 rgb <1, 1, 0>] } scale 0.2 } } map_type 1 } rotate 40*y } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { image_pattern { function 30, 30 { pattern { wood scale 0.3 } } interpolate 2 } color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] } } }
