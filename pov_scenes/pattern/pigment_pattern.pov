// `pigment_pattern`: the grey of a pigment drives a map.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare P = pigment { gradient y }
plane { -z, -1 pigment { pigment_pattern { bozo color_map { [0 rgb 0] [1 rgb <1, 0.5, 0>] } scale 0.5 } color_map { [0.2 rgb 1] [0.5 rgb <0, 0, 1>] } scale 1.2 } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { pigment_pattern { checker rgb 0.2 rgb 0.7 scale 0.3 } sine_wave color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] } } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { pigment_pattern { P turbulence 0.2 } frequency 2 pigment_map { [0 rgb 1] [0.6 granite] } scale 0.5 } }
