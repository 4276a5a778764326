// `steps` is a free name.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare steps = 5;
#for (I, 1, steps) sphere { <I - 3, 0, 0> * 0.7, 0.3 } #end
