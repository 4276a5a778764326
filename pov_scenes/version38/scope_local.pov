// `local.Name` is the name of the innermost scope alone.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare R = 1;
#macro Ball(At) #ifdef (local.R) sphere { At, 0.2 } #else #local R = 0.5; sphere { At, local.R pigment { rgb <1, 0.5, 0.2> } } #end #end
Ball(-2*x)
Ball(0)
sphere { 2*x, local.R }
