// A colour may be a comparison, a logical value or a choice, without parentheses.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -6> look_at 0 angle 42 }
light_source { <5, 8, -6>, rgb 1 }
background { <1, 2, 3, 0, 0> > <2, 1, 4, 0, 0> }

sphere { -1.5*x, 0.7 pigment { rgb <1, 2, 3> < 2 } }
sphere { 0, 0.7 pigment { rgb 1 = 2 ? x : y } }
sphere { 1.5*x, 0.7 pigment { color rgb x | z } }
