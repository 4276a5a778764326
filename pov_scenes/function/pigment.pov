// `pigment { function { } }`: values below 0 and above 1 wrap round, waves and warps apply.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
plane { -z, -1 pigment { function { x*y - y*y/3 + sin(4*x)*0.2 } } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { function { abs(x*y) + select(z + 0.3, x, 0, y*y) } color_map { [0 rgb <1, 0.9, 0.6>] [0.5 rgb <0.2, 0.5, 0.3>] [1 rgb <0.1, 0.1, 0.4>] } turbulence 0.3 scale 0.4 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { function { sum(i, 1, 4, sin(i*x)/i) } color_map { [0 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.4, 0.8>] } frequency 2 sine_wave scale 0.5 } }
