// `#undef global.X` in a macro removes the global name and leaves the local one.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare R = 1;
#macro M() #local R = 0.4; #undef global.R sphere { -2*x, R } #end
M()
#ifdef (R) sphere { 0, 1 } #else sphere { 0, 0.6 pigment { rgb <1, 0.5, 0.2> } } #end
