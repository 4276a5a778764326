// An entry that a dictionary lacks is an argument that is left out.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare D = dictionary { .Size: 0.9 }
#macro Ball(At, optional R) #ifndef (local.R) #local R = 0.4; #end sphere { At, R } #end
Ball(-1.5*x, D.Size)
Ball(1.5*x, D.Missing)
