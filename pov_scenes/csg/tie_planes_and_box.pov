// A sphere whose box is hit shifts the order of coincident planes in the heap: behind it the second wins, beside it the last.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <4.5, 5, -4.5> look_at <0, 1, 0> angle 50 }
light_source { <-6, 9, -3>, rgb 1 }
plane { y, 0 pigment { rgb 0.5 } }
plane { y, 1 pigment { rgb x } }
plane { y, 1 pigment { rgb y } }
sphere { 0, 1.1 pigment { rgb z } }
