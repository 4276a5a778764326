// Wires thinner than a pixel, near and far, against a bright sky.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 angle 40 }
light_source { <-4, 6, -8>, rgb 0.8 }
background { rgb <0.7, 0.75, 0.8> }
#for (I, 0, 11)
  cylinder { <-3, -1.6 + 0.23*I, 0.3*I>, <3, -1.3 + 0.27*I, 0.2*I>, 0.003 + 0.001*I
    pigment { rgb <0.1, 0.08, 0.05> } finish { ambient 0.1 diffuse 0.5 } }
#end
