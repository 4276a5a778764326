// `global.Name` is the name of the scene itself, whatever hides it.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare R = 1;
#macro Ball(At) #local R = 0.4; sphere { At, R } sphere { At + 1.5*y, global.R * 0.5 pigment { rgb <1, 0.5, 0.2> } } #declare global.R = 0.8; #end
Ball(-2*x)
Ball(0)
sphere { 2*x, R }
