// `warp { black_hole }`: strength, falloff, inverse.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { checker scale 0.2 warp { black_hole <-1, 0, 1>, 1 } } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { gradient x color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] } scale 0.3 warp { black_hole <1, 0, -1>, 0.8 strength 1.5 falloff 1.2 } } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { gradient y color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] } scale 0.3 warp { black_hole <-1, 0, -0.5>, 0.9 inverse strength 2 } scale 0.7 } }
