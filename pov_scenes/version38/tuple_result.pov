// A macro returns a tuple.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Both(A) (A * 0.5, A * <1, 0, 0>) #end
#local (R, At) = Both(2);
sphere { At, R * 0.8 pigment { rgb <1, 0.5, 0.2> } }
#declare (S, From) = Both(-1.5);
sphere { From, -S }
