// Functions of a pattern and of a pigment, mixed in a formula that colours.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 0.4, -6> look_at <0.3, 0.4, 0> angle 40 }
light_source { <-4, 6, -8>, rgb 1 }
#declare P = function { pattern { wood turbulence 0.2 scale 0.4 } }
#declare C = function { pigment { bozo color_map { [0 rgb <1, 0.2, 0>] [1 rgb <0, 0.5, 1>] } scale 0.3 } }
#declare T = function { transform { rotate 30*z scale <2, 1, 1> } }
plane { -z, -1 pigment { function { P(x, y, z) * C(x, y, z).red } } finish { ambient 1 diffuse 0 } }
sphere { <0.8, -0.2, 0>, 1 pigment { function { P(T(x, y, z).x, T(x, y, z).y, z) } } }
box { <-1.4, -0.6, -0.6>, <-0.2, 0.6, 0.6> rotate <20, 30, 0> pigment { function { C(y, z, x).gray } } }
