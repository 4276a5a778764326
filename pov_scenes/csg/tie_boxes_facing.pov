// Where faces of two boxes coincide, the box that the ray enters first is seen, by POV-Ray's single precision: the
// larger one where the rays run obliquely, the one declared first where both are entered at the same number.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.4, 0.3, 5> look_at 0 angle 50 }
light_source { <4, 6, 8>, rgb 1 }
box { <-2, -2, -1.3>, <2, 2, 0> pigment { rgb <0.3, 0.8, 0.4> } }
box { <-1, -1, -1>, <1.2, 1, 0> pigment { rgb <0.9, 0.3, 0.3> } }
sphere { <1.6, 0.2, 0>, 0.3 pigment { rgb <0.3, 0.4, 0.9> } }
