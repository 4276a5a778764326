// A cylinder, a cone and a box with one top, and glass that stands on them: the distances of rays that go on through glass
// depend on the last digits of the points on it, which are POV-Ray's wherever surfaces may coincide.
#version 3.7;
global_settings { assumed_gamma 1 }
#default { finish { ambient 1 diffuse 0 } }
camera { location <0, 0, -10> direction z right x*4/3 up y rotate <35, 20, 0> }
light_source { <190, 679, -250>, 1 }
background { rgb <0.2, 0.3, 0.9> }
cylinder { -3.1*y, -2.2*y, 3 pigment { rgb x } }
box { <-4, -3.7, -4>, <4, -2.2, 4> pigment { rgb y } }
cone { -3.7*y, 2.9, -2.2*y, 3.4 pigment { rgb z } }
#default { pigment { rgb 1 filter 0.8 } }
cone { -2.2*y, 2, 1.7*y, 3.5 }
sphere { <3.2, -1.2, -1>, 1 }
plane { y, -20 pigment { rgb 0.5 } }
