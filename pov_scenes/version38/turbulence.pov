// Turbulence of `marble` and `wood`, which displaces the points before their formulas use it.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare Map = color_map { [0 rgb <1, 0.9, 0.6>] [0.3 rgb <0.2, 0.5, 0.3>] [0.7 rgb <0.8, 0.2, 0.1>] [1 rgb <0.1, 0.1, 0.4>] }
#declare Rings = function { pattern { wood turbulence 0.2 scale 0.3 } }
plane { -z, -1 pigment { marble turbulence <0.5, 0.2, 1> octaves 4 color_map { Map } } finish { emission 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { wood turbulence <0.1, 0.3, 0.5> color_map { Map } scale 0.4 } normal { marble 0.3 turbulence 0.4 scale 0.5 } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { function { Rings(x, y, z) } color_map { Map } } }
