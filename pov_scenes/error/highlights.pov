// Highlights smaller than a pixel on many little balls.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -9> look_at 0 angle 36 }
light_source { <-6, 9, -8>, rgb 0.7 }
background { rgb 0.1 }
#for (I, 0, 13) #for (J, 0, 9)
  sphere { <(I - 6.5)*0.42, 0, (J - 4.5)*0.42>, 0.17
    pigment { rgb <0.15 + 0.03*I, 0.2, 0.5 - 0.04*J> }
    finish { ambient 0.05 diffuse 0.5 specular 0.6 roughness 0.0015 } }
#end #end
