// A parameter without an argument shows the outer variable of its name.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare R = 0.9;
#macro Ball(At, optional R) sphere { At, R } #end
Ball(-1.5*x, )
Ball(1.5*x, 0.5)
