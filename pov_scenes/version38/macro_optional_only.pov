// The only argument of a macro, if optional, needs no comma to be left out.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#macro Ball(optional R) #ifdef (local.R) sphere { -1.5*x, R } #else sphere { 1.5*x, 0.5 } #end #end
Ball()
Ball(0.9)
