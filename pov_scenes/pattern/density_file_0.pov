// `density_file` of one, two and four bytes with `interpolate 0`.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { density_file df3 "densities/bytes.df3" color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] } scale 4 translate <-2, -2, -1> } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { density_file df3 "densities/words.df3" color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] } scale 2.2 translate <-0.3, -1.2, -1.1> } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { density_file df3 "densities/longs.df3" color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] } scale 1.6 translate <-1.6, -0.8, -0.8> } }
