// An item of a mixed array changes its kind when it is declared again.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A = array mixed[2] { 1, "text" }
#declare A[0] = sphere { -x, 0.9 }
#declare A[1] = 0.6;
object { A[0] pigment { rgb <1, 0.5, 0.2> } }
sphere { x, A[1] }
