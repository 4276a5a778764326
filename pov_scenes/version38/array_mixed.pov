// An `array mixed` holds values of any kinds: objects, textures, colours, numbers, strings and vectors.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare A = array mixed[6];
#declare A[0] = sphere { -2*x, 0.8 }
#declare A[1] = texture { pigment { rgb <1, 0.5, 0.2> } finish { phong 0.5 } }
#declare A[2] = rgb <0.2, 0.5, 1>;
#declare A[3] = 0.7;
#declare A[4] = "yes";
#declare A[5] = <2, 0, 0>;
object { A[0] texture { A[1] } }
sphere { 0, A[3] pigment { color A[2] } }
#if (strcmp(A[4], "yes") = 0) sphere { A[5], A[3] + 0.1 pigment { color A[2] * 1.5 } } #end
