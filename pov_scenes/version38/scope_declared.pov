// `#declare local.X` and `#declare global.X` choose the scope of a new name.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro M() #declare local.P = 0.3; #declare global.Q = 0.9; sphere { -2*x, P } #end
M()
#ifdef (P) sphere { 0, 1 } #else sphere { 0, 0.5 } #end
sphere { 2*x, Q pigment { rgb <1, 0.5, 0.2> } }
