// A plate with a hundred holes.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference {
  box { <-1.5, -0.15, -1.5>, <1.5, 0.15, 1.5> }
  #for (I, 0, 9)
    #for (J, 0, 9)
      cylinder { <I*0.28 - 1.26, -1, J*0.28 - 1.26>, <I*0.28 - 1.26, 1, J*0.28 - 1.26>, 0.09 }
    #end
  #end
  rotate <-30, 25, 0>
  pigment { rgb <0.8, 0.8, 0.9> }
}
