// An optional argument may be left out after its comma; its parameter is then undeclared.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Ball(At, optional R) #ifndef (local.R) #local R = 0.4; #end sphere { At, R } #end
Ball(-2*x, )
Ball(0, 0.8)
Ball(2*x, Undeclared)
