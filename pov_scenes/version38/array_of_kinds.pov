// An array of one kind still takes it from its first item.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A = array[2];
#declare A[1] = sphere { x, 0.8 }
#declare A[0] = sphere { -x, 0.6 }
union { object { A[0] } object { A[1] } pigment { rgb <1, 0.5, 0.2> } }
